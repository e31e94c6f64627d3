// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Starts the page that draws variants in the same diagrams. All numbers come from the tables of the
// runs and from squeal.variants.

const across = data.swept.includes("friction") || !data.swept.length ? "friction" : data.swept[0];
const others = data.parameters.filter((name) => name !== across);
const swept = data.parameters.filter((name) => name === across || data.swept.includes(name));
const hasNames = data.modes.some(({rows}) => rows.flat().some((cell) => cell && cell.name));
const hidden = new Set();
const charts = [];

const lineOf = (table, i) => others.map((name) => table[name][i]).join(",");
const key = (table, i) => data.parameters.map((name) => table[name][i]).join(",");
const nameOf = (names, values) =>
    names.filter((name) => swept.includes(name)).map((name, k) => `${name} ${values[k]}`);
const percent = (value) => (value === null || value === undefined ? null : 100 * value);
const isUndecided = (verdict) => verdict === "undecided" || verdict === "uncertified";

/** The look of a variant: colours and shapes are repeated at different distances. */
function look(k) {
  return {
    colour: palette[k % palette.length],
    shape: shapes[k % shapes.length],
    size: Math.max(3.2, 5.6 - 0.8 * k)
  };
}

function stateOf(table, i) {
  if (table.grows[i]) return "unstable";
  return isUndecided(table.verdict[i]) ? "doubtful" : "calm";
}

function wordsOf(variant, i) {
  const e = variant.eigenvalues;
  const damping = e.damping_ratio ? percent(e.damping_ratio[i]) : null;
  return [
    variant.name, `mode ${e.mode[i]} at ${swept.map((n) => `${n} ${digits(e[n][i])}`).join(", ")}`,
    `${digits(e.frequency_hz[i], 8)} Hz`, `growth ${digits(e.growth_rate_1_per_s[i])} 1/s`,
    ...(damping === null ? [] : [`damping ${digits(damping, 4)} %`]),
    ...(e.name && e.name[i] ? [e.name[i]] : []), e.verdict[i]
  ].join("\n");
}

/** The rows of a variant that a chart shows, as points. */
function pointsOf(variant, x, y, shown) {
  const e = variant.eigenvalues;
  return e.mode.map((_, i) => i)
      .filter((i) => shown(e, i))
      .map(
          (i) =>
              ({x: x(e, i), y: y(e, i), state: stateOf(e, i), text: wordsOf(variant, i), row: i}))
      .filter((p) => p.x !== null && p.y !== null);
}

/** The followed eigenvalues of a variant on the shown line of the sweep. */
function branchesOf(variant, y) {
  const b = variant.branches, found = new Map();
  if (!b || across !== "friction") return [];
  for (let i = 0; i < b.branch.length; ++i) {
    if (lineOf(b, i) !== element("line").value || b.in_band[i] === 0) continue;
    if (!found.has(b.branch[i])) found.set(b.branch[i], []);
    found.get(b.branch[i]).push({x: b.friction[i], y: y(b, i)});
  }
  return [...found.values()].map((points) => points.sort((p, q) => p.x - q.x));
}

const frequency = (table, i) => table.frequency_hz[i];
const growth = (table, i) => table.growth_rate_1_per_s[i];
const damping = (table, i) => (table.damping_ratio ? percent(table.damping_ratio[i]) : null);
const isOnLine = (table, i) => lineOf(table, i) === element("line").value;

/** Whether a row is at the point of the stability chart, or on the line if this shows all. */
function isChosen(table, i) {
  const point = element("point").value;
  return point ? key(table, i) === point : isOnLine(table, i);
}

function setsOf(chart) {
  return data.variants.map((variant, k) => ({variant, k}))
      .filter(({k}) => !hidden.has(k))
      .map(({variant, k}) => ({
             ...look(k),
             name: variant.name,
             variant,
             points: pointsOf(variant, chart.x, chart.y, chart.shown),
             lines: chart.branches ? branchesOf(variant, chart.y) : []
           }));
}

/** The table of a chart: all its points. */
function pointsTable(sets) {
  const head = ["variant", ...swept, "mode", "frequency Hz", "growth 1/s", "damping %", "verdict"];
  const body = sets.flatMap((set) => set.points.map(({row}) => {
    const e = set.variant.eigenvalues;
    const values = swept.map((name) => e[name][row]);
    return [
      set.name, ...values, e.mode[row], digits(frequency(e, row), 8), growth(e, row),
      digits(damping(e, row), 4), e.verdict[row]
    ];
  }));
  return tableOf(head, body);
}

function redraw() {
  for (const chart of charts) {
    const sets = setsOf(chart), picture = draw(sets, chart.titles);
    picture.addEventListener("pointermove", (event) => hover(picture, event));
    picture.addEventListener("pointerleave", () => {
      element("hover").hidden = true;
    });
    chart.picture.replaceWith(picture);
    chart.picture = picture;
    chart.table.replaceChildren(...(chart.details.open ? [pointsTable(sets)] : []));
  }
}

function hover(picture, event) {
  const box = element("hover"), words = wordsAt(picture, event);
  box.hidden = !words;
  box.textContent = words;
  box.style.left = `${Math.min(event.clientX + 12, innerWidth - 260)}px`;
  box.style.top = `${Math.min(event.clientY + 12, innerHeight - 130)}px`;
}

function button(text, onClick) {
  const made = make("button", {type: "button", textContent: text});
  made.addEventListener("click", onClick);
  return made;
}

function addChart(id, chart) {
  const box = make("figure", {id}), details = make("details"), controls = make("div");
  Object.assign(chart, {picture: svg("svg"), details, table: make("div", {className: "scroll"})});
  controls.className = "controls";
  controls.append(
      button("Save as SVG", () => saveSvg(chart.picture, id)),
      button("Save as PNG", () => savePng(chart.picture, id)));
  chart.table.tabIndex = 0;
  details.append(make("summary", {textContent: `Table: ${chart.titles.label}`}), chart.table);
  details.addEventListener("toggle", () => {
    chart.table.replaceChildren(...(details.open ? [pointsTable(setsOf(chart))] : []));
  });
  box.append(
      make("figcaption", {textContent: chart.titles.label}), chart.picture, controls, details);
  element("figures").append(box);
  charts.push(chart);
}

function makeCharts() {
  const sweep = {friction: "friction coefficient"}[across] || `${across} factor`;
  const value = (table, i) => table[across][i];
  const hertz = "frequency [Hz]";
  addChart("stability", {
    x: frequency,
    y: damping,
    shown: isChosen,
    titles: {x: hertz, y: "damping ratio [%]", zero: true, label: "Damping ratio over frequency"}
  });
  addChart("frequency", {
    x: value,
    y: frequency,
    shown: isOnLine,
    branches: true,
    titles: {x: sweep, y: hertz, label: `Frequency over ${across}`}
  });
  addChart("growth", {
    x: value,
    y: growth,
    shown: isOnLine,
    branches: true,
    titles: {x: sweep, y: "growth rate [1/s]", zero: true, label: `Growth rate over ${across}`}
  });
}

/** Names and verdicts of the variants, each with its marker and a box that hides it. */
function makeLegend() {
  data.variants.forEach((variant, k) => {
    const row = make("li"), label = make("label"), {colour, shape} = look(k);
    const box = make("input", {type: "checkbox", checked: true});
    const mark = svg("svg", {width: 16, height: 16, "aria-hidden": "true"});
    mark.append(svg("path", {d: outline(shape, 8, 8, 6), fill: colour}));
    box.addEventListener("change", () => {
      if (box.checked)
        hidden.delete(k);
      else
        hidden.add(k);
      redraw();
    });
    label.append(box, mark, make("b", {textContent: variant.name}), variant.sentence);
    row.append(label);
    element("legend").append(row);
  });
}

function addChoice(list, value, text) {
  list.append(make("option", {value, textContent: text}));
}

/** Offers the lines of the sweep, and the points of the chosen one. */
function makeChoices() {
  const found = new Map();
  for (const {eigenvalues: e} of data.variants)
    for (let i = 0; i < e.mode.length; ++i)
      found.set(lineOf(e, i), others.map((name) => digits(e[name][i])));
  for (const [line, values] of found)
    addChoice(element("line"), line, nameOf(others, values).join(", ") || line);
  element("lines").hidden = found.size < 2;
  element("line").addEventListener("change", () => {
    offerPoints();
    redraw();
  });
  element("point").addEventListener("change", redraw);
  offerPoints();
}

/** The points of the chosen line; the last common one is shown first. */
function offerPoints() {
  const list = element("point"), found = new Map();
  for (const {eigenvalues: e} of data.variants)
    for (let i = 0; i < e.mode.length; ++i)
      if (isOnLine(e, i)) found.set(key(e, i), e[across][i]);
  list.replaceChildren();
  addChoice(list, "", "all points");
  for (const [point, value] of [...found].sort((p, q) => p[1] - q[1]))
    addChoice(list, point, `${across} ${digits(value)}`);
  const common = data.common.map((point) => point.join(",")).filter((point) => found.has(point));
  list.value = common.length ? common[common.length - 1] : "";
}

function titled(table, title) {
  table.prepend(make("caption", {textContent: title}));
  return table;
}

function makeRankings() {
  for (const {criterion, rows} of data.rankings) {
    const n = rows.some((row) => row[3]) ? 4 : 3;
    const head = ["rank", "variant", "value", "remark"].slice(0, n);
    const table = tableOf(head, rows.map((row) => row.slice(0, n)), n);
    element("rankings").append(titled(table, `By ${criterion}`));
  }
}

const signed = (value, n) => `${value > 0 ? "+" : ""}${digits(value, n)}`;

/** The rows of a table of what changed: the values of the variants, with their changes. */
function changed(rows, textOf, unit) {
  return rows.map(([name, values, changes]) => [name, ...values.map((value, k) => {
                    const change = changes[k];
                    return textOf(value) +
                        (change === null || !change ? "" : ` (${signed(change, 4)}${unit})`);
                  })]);
}

function makeChanges() {
  const names = data.variants.map((variant) => variant.name);
  const n = names.length + 1, box = make("div", {className: "scroll"});
  const options = changed(data.options, (value) => value || "not given", " %");
  const results = changed(data.results, (value) => (value === null ? "none" : digits(value)), "");
  box.append(
      titled(tableOf(["option", ...names], options, n), "Options that differ"),
      titled(
          tableOf(["result at common points", ...names], results, 1),
          "Results, with differences from the first variant"));
  if (!options.length) box.prepend(make("p", {textContent: "No option differs."}));
  element("changes").append(box);
}

/** The cells of a mode in one variant; those of all except the first have changes. */
function cellsOf(cell, isFree, isFirst) {
  const count = headsOf(isFree, isFirst).length;
  if (!cell) return [isFirst ? "" : "no partner", ...Array(count - 1).fill("")];
  const s = [cell.mode, ...(hasNames ? [cell.name] : []), digits(cell.frequency_hz, 7)];
  if (!isFirst) s.push(cell.matched_by ? signed(cell.frequency_change_hz, 4) : "");
  if (!isFree) s.push(digits(cell.growth_rate_1_per_s, 5));
  if (!isFree && !isFirst) s.push(cell.matched_by ? signed(cell.growth_change_1_per_s, 4) : "");
  if (!isFree && isFirst) s.push(cell.verdict);
  if (isFirst) return s;
  const mac = cell.mac === null ? "" : ` ${digits(cell.mac, 3)}`;
  return [...s, cell.matched_by ? cell.matched_by + mac : "no partner"];
}

function headsOf(isFree, isFirst) {
  const heads = ["mode", ...(hasNames ? ["name"] : []), "frequency Hz"];
  if (!isFirst) heads.push("change Hz");
  if (!isFree) heads.push("growth 1/s");
  if (!isFree && !isFirst) heads.push("change 1/s");
  if (!isFree && isFirst) heads.push("verdict");
  return isFirst ? heads : [...heads, "matched by"];
}

function listModes() {
  const group = data.modes[element("group").value], isFree = group.kind === "free";
  const wanted = (row) => isFree || !element("filter").value ||
      row.some((cell) => cell && (cell.verdict === "unstable" || isUndecided(cell.verdict)));
  const rows = group.rows.filter(wanted);
  const heads = data.variants.map((_, k) => headsOf(isFree, !k));
  const table = tableOf(
      heads.flat(), rows.map((row) => row.flatMap((cell, k) => cellsOf(cell, isFree, !k))), 0);
  const top = table.tHead.insertRow(0);
  data.variants.forEach((variant, k) => {
    const cell = make("th", {colSpan: heads[k].length, textContent: variant.name});
    cell.scope = "colgroup";
    cell.className = "word";
    top.append(cell);
  });
  element("modes").replaceChildren(table);
  element("count").textContent = `${rows.length} of ${group.rows.length} rows`;
}

function makeModes() {
  data.modes.forEach((group, k) => addChoice(element("group"), k, group.name));
  element("group").value = data.modes.length - 1;
  element("group").addEventListener("change", listModes);
  element("filter").addEventListener("change", listModes);
  listModes();
}

function makeCritical() {
  const body = data.variants.flatMap(({name, critical: c}) => {
    if (!c) return [[name, "eigenvalues were not followed"]];
    return c.friction.map(
        (friction, i) =>
            [name, c.direction[i] === "loss" ? "lost" : "regained", c.kind[i], digits(friction, 8),
             c.friction_error_estimate ? c.friction_error_estimate[i] : "",
             digits(c.frequency_hz[i], 7)]);
  });
  const head = ["variant", "stability", "kind", "friction", "estimated error", "frequency Hz"];
  const box = make("div", {className: "scroll"});
  box.append(tableOf(head, body, 3));
  element("critical").append(box);
}

function setScheme(dark) {
  document.documentElement.classList.toggle("dark", dark);
  element("scheme").textContent = dark ? "Light" : "Dark";
  redraw();
}

function begin() {
  element("main").hidden = false;
  makeLegend();
  makeChoices();
  makeCharts();
  makeRankings();
  makeChanges();
  makeModes();
  makeCritical();
  element("scheme").addEventListener("click", () => {
    setScheme(!document.documentElement.classList.contains("dark"));
  });
  setScheme(matchMedia("(prefers-color-scheme: dark)").matches);
  document.documentElement.dataset.ready = "yes";
}

begin();
