// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The sensitivities of the selected mode as ranked changes, for one per cent of each parameter.

const mostChanges = 15;
const sensitivityRows = rowsByMode(data.sensitivities);

/** Growth rate and frequency change by this for 1 % more of the parameter of row k. */
function changesOf(k) {
  const s = data.sensitivities, whole = s.parameter[k] === "friction" ? s.friction[k] : 1;
  return [s.growth_rate_derivative_1_per_s[k], s.frequency_derivative_hz[k]].map(
      (value) => (value * whole) / 100);
}

/** The change of the parameter of row k, in per cent, up to which the growth rate is linear. */
function holdsTo(k) {
  const s = data.sensitivities, range = s.growth_holds_to ? s.growth_holds_to[k] : null;
  const whole = s.parameter[k] === "friction" ? s.friction[k] : 1;
  return range === null || !whole ? "" : digits((100 * range) / whole, 2);
}

/** The rows of the selected mode with derivatives, the largest change of growth first. */
function rankedChanges() {
  const s = data.sensitivities, list = sensitivityRows.get(modeKey(eigen, state.selected)) || [];
  return list.filter((k) => s.growth_rate_derivative_1_per_s[k] !== null)
      .sort((a, b) => Math.abs(changesOf(b)[0]) - Math.abs(changesOf(a)[0]));
}

function showChanges() {
  if (!sensitivityRows.size) return;
  const s = data.sensitivities, order = rankedChanges();
  const shown =
      order.filter((k) => changesOf(k).some((value) => value !== 0)).slice(0, mostChanges);
  element("changesmode").textContent = element("chosen").textContent;
  element("changeframe").hidden = !order.length;
  element("nochanges").hidden = order.length > 0;
  [["growthchange", "1/s", ["#c8423b", "#2f6db5"]],
   ["frequencychange", "Hz", [palette[2], palette[2]]]]
      .forEach(([id, unit, [more, less]], part) => {
        const values = shown.map((k) => changesOf(k)[part]);
        const backgroundColor = values.map((value) => (value > 0 ? more : less));
        setBars(id, shown.map((k) => s.parameter[k]), [{unit, data: values, backgroundColor}]);
      });
  const head =
      ["parameter, 1 % more", "growth rate 1/s", "frequency Hz", "growth rate holds to ± %"];
  element("changetable")
      .replaceChildren(tableOf(
          head,
          order.map(
              (k) =>
                  [s.parameter[k], ...changesOf(k).map((value) => digits(value, 4)), holdsTo(k)])));
}

function makeChanges() {
  if (!sensitivityRows.size) return;
  element("changes").hidden = false;
  barChart("growthchange", "change of the growth rate [1/s] for 1 % more");
  barChart("frequencychange", "change of the frequency [Hz] for 1 % more");
}
