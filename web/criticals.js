// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The derivatives of the critical frictions as ranked changes, for one per cent of each parameter,
// and the free modes that meet there.

const criticalKeys = ["active_set", "branch", "partner", "kind", "direction", ...data.parameters];
const criticalKey = (table, i) => criticalKeys.map((name) => table[name][i]).join(",");
const criticalChanges = changesByCritical();

/** The rows with derivatives of each critical friction, the largest first. */
function changesByCritical() {
  const found = new Map(), s = data.criticalSensitivities;
  if (!s) return found;
  const size = (k) => Math.abs(s.friction_derivative[k]);
  s.parameter.forEach((_, k) => {
    if (s.friction_derivative[k] === null) return;
    const key = criticalKey(s, k);
    found.set(key, [...(found.get(key) || []), k]);
  });
  for (const list of found.values()) list.sort((a, b) => size(b) - size(a));
  return found;
}

/** The free modes of row i of the critical frictions, with their shares of the energy. */
function meetingModes(i) {
  const c = data.critical;
  return [["free_mode", "energy_share"], ["second_free_mode", "second_energy_share"]]
      .filter(([mode, share]) => c[mode] && c[mode][i] !== null && c[share][i] >= 0.1)
      .map(([mode, share]) => `${c[mode][i]} (${digits(100 * c[share][i], 2)} %)`)
      .join(" and ");
}

function showCriticalChanges() {
  const c = data.critical, s = data.criticalSensitivities;
  const i = Number(element("criticalchoice").value);
  const list = criticalChanges.get(criticalKey(c, i));
  const change = (k) => s.friction_derivative[k] / 100;
  const modes = meetingModes(i), name = (c.name && c.name[i]) || "";
  element("criticalwords").textContent = [
    `${c.kind[i]}, stability is ${c.direction[i] === "loss" ? "lost" : "regained"}`,
    ...(modes ? [`free modes ${modes}`] : []), ...(name ? [name] : [])
  ].join(" · ");
  const shown = list.filter((k) => change(k) !== 0).slice(0, mostChanges);
  const values = shown.map(change);
  const backgroundColor = values.map((value) => (value > 0 ? "#2f6db5" : "#c8423b"));
  setBars("criticalchange", shown.map((k) => s.parameter[k]), [{data: values, backgroundColor}]);
  element("criticalchangetable")
      .replaceChildren(tableOf(
          ["parameter, 1 % more", "critical friction"],
          list.map((k) => [s.parameter[k], digits(change(k), 4)])));
}

function makeCriticalChanges() {
  const c = data.critical;
  if (!c || !criticalChanges.size) return;
  const choice = element("criticalchoice");
  c.friction.forEach((friction, i) => {
    if (!criticalChanges.has(criticalKey(c, i))) return;
    const others = data.swept.filter((name) => name !== "friction");
    const place = others.map((name) => `, ${name} ${digits(c[name][i])}`).join("");
    choice.add(new Option(`${digits(friction, 6)}, ${digits(c.frequency_hz[i], 6)} Hz${place}`, i));
  });
  element("criticalchanges").hidden = false;
  barChart("criticalchange", "change of the critical friction for 1 % more", {ofMode: false});
  choice.addEventListener("change", showCriticalChanges);
  showCriticalChanges();
}
