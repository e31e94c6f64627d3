// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The sections below the table: further results, times and options.

function section(title, ...content) {
  const box = make("details"), frame = make("div", {className: "scroll"});
  frame.append(...content);
  box.append(make("summary", {textContent: title}), frame);
  element("more").append(box);
}

function bar(value, most) {
  const mark = make("span", {className: "bar"});
  mark.style.width = `${(10 * Math.abs(value)) / most}rem`;
  mark.style.opacity = value < 0 ? 0.4 : 1;
  return mark;
}

/** A section with a table, the largest of the last column first, and bars for that column. */
function bars(title, table, keys, value, heads) {
  if (!table || !table[value]) return;
  const size = (i) => Math.abs(table[value][i]);
  const present = table[value].map((_, i) => i).filter((i) => table[value][i] !== null);
  if (!present.length) return;
  const order = present.sort((a, b) => size(b) - size(a)).slice(0, 200);
  const most = size(order[0]) || 1;
  const cell = (key, i) => (key === "point" ? nameOfPoint(table, i) : table[key][i]);
  const line =
      (i) => [...keys.map((key) => cell(key, i)), table[value][i], bar(table[value][i], most)];
  section(title, tableOf([...heads, ""], order.map(line)));
}

/** The cell of a map: the largest growth rate of point i and the number of unstable modes. */
function mapCell(i, most) {
  const p = data.points, mark = make("span");
  if (i === undefined || p.unstable_modes[i] === null)
    mark.textContent = "no steady sliding";
  else if (p.unstable_modes[i] === 0)
    mark.textContent = p.verdict[i];
  else {
    const value = p.largest_growth_rate_1_per_s[i];
    const place = Math.round(31 * (1 - Math.max(0, value) / most));
    mark.textContent = `${digits(value, 4)} (${p.unstable_modes[i]})`;
    mark.style.background = rgb(data.colours[place]);
    mark.style.color = place > 15 ? "#000" : "#fff";
    mark.style.padding = "0 0.4rem";
  }
  return mark;
}

/** The map of the points of a list, over the parameters `across` and `columnsOf`. */
function mapOf(list, columnsOf, key, most) {
  const p = data.points;
  const ascending = (name) => [...new Set(list.map((i) => p[name][i]))].sort((a, b) => a - b);
  const head = ascending(columnsOf), body = ascending(across).reverse();
  const at = (x, y) => list.find((i) => p[columnsOf][i] === x && p[across][i] === y);
  const corner = `${across} \\ ${columnsOf}${key ? `, at ${key}` : ""}`;
  const line = (y) => [digits(y), ...head.map((x) => mapCell(at(x, y), most))];
  return tableOf([corner, ...head.map((x) => digits(x))], body.map(line));
}

/**
 * The stability maps over the parameter across and the one with most values of the others: one map
 * for each combination of values of the remaining ones.
 */
function maps() {
  const p = data.points, all = p.friction.map((_, i) => i);
  const count = (name) => new Set(p[name]).size;
  const further = data.swept.filter((name) => name !== across);
  const columnsOf = further.reduce((a, b) => (count(b) > count(a) ? b : a));
  const rest = further.filter((name) => name !== columnsOf);
  const growthOf = (i) => (p.unstable_modes[i] > 0 ? p.largest_growth_rate_1_per_s[i] : 0);
  const most = Math.max(...all.map(growthOf), 1e-300);
  const keyOf = (i) => rest.map((name) => `${name} ${digits(p[name][i])}`).join(", ");
  const mapAt = (key) => mapOf(all.filter((i) => keyOf(i) === key), columnsOf, key, most);
  return [...new Set(all.map(keyOf))].map(mapAt);
}

/** The elastic modes of each body by itself, one table per body. */
function makeComponentModes() {
  const c = data.componentModes;
  if (!c || !c.body.length) return;
  const head = ["mode", "frequency Hz", "motion", "share %"];
  const percentage = (share) => (share === null ? "" : digits(100 * share, 4));
  const line =
      (i) => [c.mode[i], digits(c.frequency_hz[i], 8), c.motion[i], percentage(c.motion_share[i])];
  const tableOfBody = (name) => {
    const list = c.body.map((_, i) => i).filter((i) => c.body[i] === name);
    return [make("h3", {textContent: name}), tableOf(head, list.map(line))];
  };
  section("Elastic modes of each body by itself", ...[...new Set(c.body)].flatMap(tableOfBody));
}

function makePoints() {
  const p = data.points;
  const head = ["point", "unstable modes", "largest growth 1/s", "at Hz", "verdict"];
  const columns = ["unstable_modes", "largest_growth_rate_1_per_s", "frequency_hz", "verdict"];
  const line = (_, i) => [nameOfPoint(p, i), ...columns.map((name) => p[name][i])];
  section("Points of the sweep", tableOf(head, p.friction.map(line)));
  if (data.swept.length > 1)
    section("Stability maps: largest growth rate [1/s] and number of unstable modes", ...maps());
}

function makeCritical() {
  const c = data.critical;
  if (!c || !c.friction.length) return;
  const head = [
    "stability", "friction", "frequency Hz", "kind", "free modes", "motion",
    "estimated error of the friction"
  ];
  const line = (_, i) => {
    const change = c.direction[i] === "loss" ? "lost" : "regained";
    const frequency = digits(c.frequency_hz[i], 8);
    return [
      change, digits(c.friction[i], 10), frequency, c.kind[i], meetingModes(i),
      (c.name && c.name[i]) || "", errorOf(c, i)
    ];
  };
  section("Critical frictions", tableOf(head, c.friction.map(line)));
}

function makeInfluences() {
  bars(
      "Which interface feeds a mode: growth by its friction", data.frictionWork,
      ["point", "mode", "frequency_hz", "interface"], "friction_work_1_per_s",
      ["point", "mode", "frequency Hz", "interface", "growth 1/s"]);
}

function makeForces() {
  if (!data.steady.length) return;
  const head = ["interface", "point", "normal N", "friction N", "open nodes"];
  const n = data.parameters.length;  // the values of the parameters come first
  const line = (row) => [row[n], nameOfValues(row.slice(0, n), String), ...row.slice(n + 1)];
  section("Steady sliding: forces of the interfaces", tableOf(head, data.steady.map(line), 2));
}

function makeCosts() {
  const stages =
      Object.entries(data.stages).map(([name, [time, memory]]) => [name, time, memory / 1e6]);
  const sizes = Object.entries(data.sizes).map(([name, value]) => [name.replace("_", " "), value]);
  const head = ["stage", "time s", "largest memory so far, MB"];
  section(
      "Time, memory and size", tableOf(head, [...stages, ["all", data.wallSeconds, ""]]),
      tableOf(["size", ""], sizes));
}

function makeRecipe() {
  const options = Object.entries(data.options).map(([name, value]) => [`-${name}`, value]);
  element("recipe").append(tableOf(["option", `value (squeal ${data.version})`], options, 2));
}

function makeSections() {
  makeComponentModes();
  makePoints();
  makeCritical();
  makeProofs();
  makeInfluences();
  makeForces();
  makeCosts();
  for (const text of data.left)
    element("more").append(make("p", {className: "note", textContent: text}));
  makeRecipe();
}
