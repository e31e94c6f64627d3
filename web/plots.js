// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Diagrams of the eigenvalues by Chart.js: over the swept parameter, and the root locus.

const charts = {};
const names = {
  friction: "friction coefficient",
  speed: "speed factor",
  pressure: "pressure factor",
  damping: "damping factor"
};
const abscissa = (table, i) => table[across][i];
const hertz = (table, i) => (table.frequency_hz ? table.frequency_hz[i] : NaN);
const growth = (table, i) => (table.growth_rate_1_per_s ? table.growth_rate_1_per_s[i] : 0);

/** The branches of the line, through all changes of contact, as one list of points with gaps. */
function branchPoints(x, y) {
  const b = data.branches, found = new Map();
  if (!b || across !== "friction") return [];
  for (let i = 0; i < b.branch.length; ++i) {
    if (lineOf(b, i) !== state.line || b.in_band[i] === 0) continue;
    if (!found.has(b.branch[i])) found.set(b.branch[i], []);
    found.get(b.branch[i]).push({x: x(b, i), y: y(b, i), order: b.friction[i]});
  }
  const all = [];
  for (const points of found.values()) {
    points.sort((p, q) => p.order - q.order);
    all.push(...points, {x: NaN, y: NaN});
  }
  return all;
}

/** The first and the last friction of each active set on the line, in ascending order. */
function endsOfActiveSets() {
  const b = data.branches, ends = new Map();
  for (let i = 0; i < b.branch.length; ++i) {
    if (lineOf(b, i) !== state.line || b.active_set[i] === 0) continue;
    const [low, high] = ends.get(b.active_set[i]) || [Infinity, -Infinity];
    ends.set(b.active_set[i], [Math.min(low, b.friction[i]), Math.max(high, b.friction[i])]);
  }
  return [...ends.values()].sort((p, q) => p[0] - q[0]);
}

/** Shades every other interval of friction with one active set. */
const shading = {
  id: "shading",
  beforeDraw(chart) {
    if (!data.branches || across !== "friction" || !chart.options.shaded) return;
    const {top, bottom} = chart.chartArea, place = (x) => chart.scales.x.getPixelForValue(x);
    chart.ctx.fillStyle = css("--shade");
    for (const [low, high] of endsOfActiveSets().filter((_, k) => k % 2))
      chart.ctx.fillRect(place(low), top, place(high) - place(low), bottom - top);
  },
};

function branchSet(x, y) {
  return {
    label: "branches",
    data: branchPoints(x, y),
    showLine: true,
    pointRadius: 0,
    pointHitRadius: 0,
    borderColor: css("--line"),
    borderWidth: 1,
    order: 5
  };
}

function stableSet(points) {
  return {
    label: "stable",
    data: points,
    pointRadius: 2,
    pointHitRadius: 4,
    backgroundColor: css("--soft"),
    borderWidth: 0,
    order: 4
  };
}

function undecidedSet(points) {
  return {
    label: "undecided",
    data: points,
    pointRadius: 4,
    backgroundColor: "#0000",
    borderColor: css("--ink"),
    order: 3
  };
}

function unstableSet(points) {
  const growthOf = (i) => (eigen.grows[i] ? eigen.growth_rate_1_per_s[i] : 0);
  const most = Math.max(...rows.map(growthOf), 1e-300);
  return {
    label: "unstable",
    data: points,
    pointRadius: 5,
    pointHitRadius: 6,
    borderWidth: 0.5,
    borderColor: css("--ink"),
    backgroundColor: points.map((p) => rgb(colourOfGrowth(growthOf(p.row), most))),
    order: 2
  };
}

function selectedSet(points) {
  return {
    label: "selected",
    unlisted: true,
    data: points,
    pointRadius: 9,
    pointHitRadius: 0,
    backgroundColor: "#0000",
    borderColor: css("--accent"),
    borderWidth: 2.5,
    order: 0
  };
}

/** A critical friction in words. */
function wordsOfCritical(i) {
  const c = data.critical, change = c.direction[i] === "loss" ? "is lost" : "is regained";
  return [
    `stability ${change} (${c.kind[i]})`,
    `friction ${digits(c.friction[i], 10)} ± ${errorOf(c, i)}`, `${digits(c.frequency_hz[i], 8)} Hz`
  ].join("\n");
}

function criticalSet(x, y) {
  const c = data.critical, here = c.friction.map((_, i) => i);
  const points = here.filter((i) => lineOf(c, i) === state.line)
                     .map((i) => ({x: x(c, i), y: y(c, i), text: wordsOfCritical(i)}))
                     .filter((p) => Number.isFinite(p.y));
  return {
    label: "critical frictions",
    data: points,
    pointStyle: "crossRot",
    pointRadius: 6,
    borderColor: css("--ink"),
    borderWidth: 1.5,
    order: 1
  };
}

/** All that a diagram shows, with the abscissa and the ordinate of a row of a table. */
function datasets(x, y) {
  const at = (list) => list.map((i) => ({x: x(eigen, i), y: y(eigen, i), row: i}));
  const shown = inLine();
  const sets = [
    branchSet(x, y),
    stableSet(at(shown.filter((i) => !eigen.grows[i] && !isUndecided(i)))),
    undecidedSet(at(shown.filter(isUndecided))),
    unstableSet(at(shown.filter((i) => eigen.grows[i]))),
    selectedSet(at(shown.filter((i) => i === state.selected))),
  ];
  if (data.critical && across === "friction") sets.push(criticalSet(x, y));
  return sets;
}

/** Shows the words of the point under the pointer. */
function hover(context) {
  const box = element("hover"), tip = context.tooltip;
  const points = tip.opacity && tip.dataPoints ? tip.dataPoints.map((p) => p.raw) : [];
  const point = points.find((p) => p.row !== undefined || p.text);
  box.hidden = !point;
  if (!point) return;
  box.textContent = point.text || wordsOf(point.row);
  const frame = context.chart.canvas.getBoundingClientRect();
  box.style.left = `${Math.min(frame.left + tip.caretX + 12, innerWidth - 260)}px`;
  box.style.top = `${Math.min(frame.top + tip.caretY + 12, innerHeight - 130)}px`;
}

/** The scales of a diagram. The vertical axes of all diagrams have one width. */
function scalesOf(xTitle, yTitle) {
  const afterFit = (axis) => {
    axis.width = 72;
  };
  return {
    x: {title: {display: true, text: xTitle}},
    y: {title: {display: true, text: yTitle}, afterFit},
  };
}

function chart(id, x, y, xTitle, yTitle, shaded) {
  const onClick = (event, hits) => {
    const sets = charts[id].chart.data.datasets;
    const points = hits.map((hit) => sets[hit.datasetIndex].data[hit.index]);
    const point = points.find((p) => p.row !== undefined);
    if (point) select(point.row);
  };
  const options = {
    shaded,
    animation: false,
    maintainAspectRatio: false,
    normalized: true,
    interaction: {mode: "nearest", intersect: true},
    onClick,
    plugins: {legend: {display: false}, tooltip: {enabled: false, external: hover}},
    scales: scalesOf(xTitle, yTitle),
  };
  const settings = {type: "scatter", data: {datasets: datasets(x, y)}, plugins: [shading], options};
  charts[id] = {x, y, chart: new Chart(element(id), settings)};
  addChartFigure(charts[id].chart);
}

/** Gives the axes of a diagram the colours of the scheme. */
function colourAxes(options) {
  for (const axis of Object.values(options.scales)) {
    axis.grid = {color: css("--line"), drawOnChartArea: axis.grid.drawOnChartArea};
    axis.ticks = {...axis.ticks, color: css("--ink")};
    axis.title.color = css("--ink");
  }
}

function drawCharts() {
  Chart.defaults.devicePixelRatio = Math.max(2, devicePixelRatio);  // for print
  Chart.defaults.color = css("--ink");
  Chart.defaults.borderColor = css("--line");
  for (const one of Object.values(charts)) {
    colourAxes(one.chart.options);
    one.chart.data.datasets = datasets(one.x, one.y);
    one.chart.update("none");
  }
}

function makeCharts() {
  chart("frequency", abscissa, hertz, names[across], "frequency [Hz]", true);
  chart("growth", abscissa, growth, names[across], "growth rate [1/s]", true);
  chart("roots", growth, hertz, "growth rate [1/s]", "frequency [Hz]", false);
  for (const one of Object.values(charts))
    one.chart.canvas.addEventListener("mouseleave", () => {
      element("hover").hidden = true;
    });
  for (const id of ["sweep", "locus"]) element(id).addEventListener("keydown", walk);
  for (const button of document.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => show(button.dataset.view));
  drawCharts();
}

function show(view) {
  state.view = view;
  for (const button of document.querySelectorAll("[data-view]"))
    button.setAttribute("aria-pressed", String(button.dataset.view === view));
  element("sweep").hidden = view !== "sweep";
  element("locus").hidden = view !== "locus";
  for (const one of Object.values(charts)) one.chart.resize();
}
