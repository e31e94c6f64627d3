// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Shares of the components in the energies of the stored modes, their contributions to the growth
// rate, and the participation of the free modes.

// Contributions to the growth rate, in the order of their colours.
const terms = {
  damping_1_per_s: "damping",
  follower_1_per_s: "friction, follower part",
  friction_damping_1_per_s: "friction damping",
  law_slope_1_per_s: "slope of the friction law",
  convective_1_per_s: "convective terms",
  gyroscopic_1_per_s: "gyroscopic terms",
};
const mostComponents = 9, mostModes = 12, mostContributions = 12, mostFree = 10;
const sum = (values) => values.reduce((a, b) => a + b, 0);

/** The rows of a table by point and mode. */
function rowsByMode(table) {
  const found = new Map();
  if (!table) return found;
  table.mode.forEach((_, i) => {
    const key = modeKey(table, i);
    found.set(key, [...(found.get(key) || []), i]);
  });
  return found;
}

const modeKey = (table, i) => [...data.parameters, "mode"].map((name) => table[name][i]).join(",");
const componentRows = rowsByMode(data.components);
const participationRows = rowsByMode(data.participation);

/** The rows of the eigenvalues at the point of the selected one whose shares are known. */
function modesWithShares() {
  const place = (i) => data.parameters.map((name) => eigen[name][i]).join(",");
  return rows.filter((i) => place(i) === place(state.selected))
      .filter((i) => componentRows.has(modeKey(eigen, i)))
      .sort((a, b) => growth(eigen, b) - growth(eigen, a));
}

/** The label of a component; an interface may have the name of a body. */
function labelOfComponent(k) {
  const {kind, component} = data.components, what = kind[k].replaceAll("_", " ");
  if (kind[k] === "body") return component[k];
  return component[k] && component[k] !== kind[k] ? `${component[k]} (${what})` : what;
}

/** The components by their largest share in one of the modes, the largest first. */
function rankedComponents(modes) {
  const c = data.components, most = new Map();
  for (const k of modes.flatMap((i) => componentRows.get(modeKey(eigen, i)))) {
    const label = labelOfComponent(k);
    const size = Math.max(Math.abs(c.strain_share[k]), Math.abs(c.kinetic_share[k]));
    most.set(label, Math.max(most.get(label) || 0, size));
  }
  return [...most].sort((a, b) => b[1] - a[1]).map(([label]) => label);
}

/** The share of some components in a mode, per cent. */
function shareOf(row, column, labels) {
  const list = componentRows.get(modeKey(eigen, row));
  const chosen = list.filter((k) => labels.includes(labelOfComponent(k)));
  return 100 * sum(chosen.map((k) => data.components[column][k]));
}

const nameOfMode = (i) =>
    `${i === state.selected ? "▶ " : ""}${eigen.mode[i]}: ${digits(hertz(eigen, i), 5)} Hz`;

function drawShares(modes, names) {
  const shown = names.slice(0, mostComponents), rest = names.slice(mostComponents);
  const groups = shown.map((name, k) => [name, [name], palette[k]]);
  if (rest.length) groups.push([`${rest.length} others`, rest, otherColour]);
  for (const [id, column] of [["kinetic", "kinetic_share"], ["strain", "strain_share"]]) {
    const sets = groups.map(([label, members, backgroundColor]) => {
      const values = modes.map((i) => shareOf(i, column, members));
      return {label, unit: "%", backgroundColor, data: values};
    });
    // The rotation of the disc may take strain energy away.
    const whole = sets.every((set) => set.data.every((value) => value > -0.05));
    setBars(id, modes.map(nameOfMode), sets, whole ? {min: 0, max: 100} : {min: null, max: null});
  }
}

/** The contributions of a component of the selected mode, by term. */
function contributionsOf(k) {
  return Object.keys(terms).map((term) => data.components[term][k] || 0);
}

function drawContributions(list) {
  const c = data.components, size = (k) => sum(contributionsOf(k).map(Math.abs));
  const order = list.filter((k) => size(k) > 0).sort((a, b) => size(b) - size(a));
  const shown = order.slice(0, mostContributions), rest = order.slice(mostContributions);
  const labels = shown.map(labelOfComponent);
  if (rest.length) labels.push(`${rest.length} others`);
  const values = (t) =>
      [...shown.map((k) => contributionsOf(k)[t]),
       ...(rest.length ? [sum(rest.map((k) => contributionsOf(k)[t]))] : [])];
  const sets = Object.values(terms).map(
      (label, t) => ({label, unit: "1/s", backgroundColor: palette[t], data: values(t)}));
  setBars("contributions", labels, sets.filter((set) => set.data.some((value) => value !== 0)));
  const total = sum(list.flatMap(contributionsOf));
  element("contributionsum").textContent = `Sum of all contributions: ${digits(total, 6)} 1/s. ` +
      `Growth rate of the mode: ${digits(growth(eigen, state.selected), 6)} 1/s. ` +
      "To the right: feeds the mode; to the left: takes energy from it.";
}

const nameOfFree = (k) => {
  const p = data.participation;
  return p.free_mode[k] === 0 ?
      "all others" :
      `free mode ${p.free_mode[k]}: ${digits(p.free_frequency_hz[k], 5)} Hz`;
};

/** Draws the largest shares; the last bar has all others. */
function drawParticipation(list) {
  const p = data.participation, named = list.filter((k) => p.free_mode[k] > 0);
  const shown = named.slice(0, mostFree), rest = list.filter((k) => !shown.includes(k));
  setBars("participation", [...shown.map(nameOfFree), "all others"], [{
            unit: "%",
            data: [...shown, rest].map((k) => 100 * sum([k].flat().map((i) => p.energy_share[i]))),
            backgroundColor: [...shown.map(() => palette[0]), otherColour]
          }]);
}

/** The tables of the charts: shares of all modes of the point, contributions, participation. */
function tablesOfShares(modes, names, list, free) {
  const c = data.components, p = data.participation, tables = [];
  if (modes.length) {
    const head =
        modes.flatMap((i) => [`${eigen.mode[i]}: kinetic %`, `${eigen.mode[i]}: strain %`]);
    const pair = (i, name) => ["kinetic_share", "strain_share"].map(
        (column) => digits(shareOf(i, column, [name]), 4));
    tables.push(tableOf(
        ["component", ...head],
        names.map((name) => [name, ...modes.flatMap((i) => pair(i, name))])));
  }
  if (list.length) {
    const head = Object.values(terms).map((term) => `${term} 1/s`);
    const line = (k) => [...contributionsOf(k), sum(contributionsOf(k))].map((v) => digits(v, 5));
    tables.push(tableOf(
        ["component", ...head, "sum 1/s"], list.map((k) => [labelOfComponent(k), ...line(k)])));
  }
  if (free.length)
    tables.push(tableOf(
        ["free mode", "share of the energy %", "MAC"],
        free.map((k) => [nameOfFree(k), digits(100 * p.energy_share[k], 4), digits(p.mac[k], 4)])));
  element("sharetables").replaceChildren(...tables);
}

/** Draws the shares of the modes of the point, and those of the selected mode. */
function showShares() {
  if (!barCharts.kinetic && !barCharts.participation) return;
  const key = modeKey(eigen, state.selected);
  const list = componentRows.get(key) || [], free = participationRows.get(key) || [];
  const all = barCharts.kinetic ? modesWithShares() : [], modes = all.slice(0, mostModes);
  const names = rankedComponents(modes);
  element("sharesmode").textContent = element("chosen").textContent;
  element("energies").hidden = !modes.length;
  element("contributionframe").hidden = !list.length;
  element("participationframe").hidden = !free.length;
  element("noshares").hidden = list.length + free.length > 0;
  element("sharesleft").textContent = all.length > modes.length ?
      `The ${mostModes} fastest growing of ${all.length} modes are shown.` :
      "";
  if (modes.length) drawShares(modes, names);
  if (list.length) drawContributions(list);
  if (free.length) drawParticipation(free);
  tablesOfShares(modes, names, list, free);
}

function makeShares() {
  if (!componentRows.size && !participationRows.size) return;
  element("shares").hidden = false;
  if (componentRows.size) {
    barChart("kinetic", "share of the kinetic energy [%]", {legend: true, ofMode: false});
    barChart("strain", "share of the strain energy [%]", {legend: true, ofMode: false});
    barChart("contributions", "contribution to the growth rate [1/s]", {legend: true});
  }
  if (participationRows.size) barChart("participation", "share of the energy [%]");
}
