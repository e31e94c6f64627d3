// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The motion after flutter: growth to saturation, spectrum, and state of the contact nodes. One run
// is shown at a time.

const regime = {
  charts: {},
  run: 0,
  field: 0,
  line: 0
};

/** Points of [x, y] as Chart.js takes them. */
const pointsOf = (line) => line.map(([x, y]) => ({x, y}));

/** The words of a point: those that it has, or its coordinates. */
function labelOf(context) {
  const {text, x, y} = context.raw;
  return text || `${digits(x, 5)}, ${digits(y, 4)}`;
}

function regimeChart(id, xTitle, yTitle, logarithmic) {
  const axis = (text) => ({title: {display: true, text}});
  const y = logarithmic ? {...axis(yTitle), type: "logarithmic"} : axis(yTitle);
  regime.charts[id] = new Chart(element(id), {
    type: "scatter",
    data: {datasets: []},
    options: {
      animation: false,
      maintainAspectRatio: false,
      normalized: true,
      plugins: {legend: {display: false}, tooltip: {callbacks: {label: labelOf}}},
      scales: {x: axis(xTitle), y},
    },
  });
  addChartFigure(regime.charts[id]);
}

/** A dashed line through the diagram. */
function guide(label, from, to) {
  return {
    label,
    data: [from, to],
    showLine: true,
    pointRadius: 0,
    pointHitRadius: 0,
    borderColor: css("--soft"),
    borderDash: [5, 4],
    borderWidth: 1
  };
}

function curve(label, line) {
  return {
    label,
    data: line,
    showLine: true,
    pointRadius: 0,
    pointHitRadius: 4,
    borderColor: css("--accent"),
    borderWidth: 1
  };
}

function growthSets(run) {
  const line = pointsOf(run.cycles).map(({x, y}) => ({x: 1e3 * x, y}));
  const motion = curve("largest kinetic energy of each cycle", line);
  if (!line.length || !(run.onset > 0)) return [motion];
  const [from, to] = [line[0], line[line.length - 1]].map(({x}) => ({x, y: run.onset}));
  return [motion, guide("first node separates or sticks", from, to)];
}

function spectrumSets(run) {
  const [title, values] = Object.entries(run.spectrum)[regime.line] || ["", []];
  const line = pointsOf(values).map(({x, y}) => ({x: x / 1e3, y}));
  const spectrum = curve(title, line);
  if (!line.length || !run.flutter) return [spectrum];
  const heights = line.map(({y}) => y), at = run.flutter / 1e3;
  const [low, high] = [Math.min, Math.max].map((end) => heights.reduce((a, b) => end(a, b)));
  return [spectrum, guide("flutter mode", {x: at, y: low}, {x: at, y: high})];
}

function nodeSets(run) {
  if (!run.nodes) return [];
  const {title, unit, values} = run.nodes.fields[regime.field];
  const most = values.reduce((a, b) => Math.max(a, b), 0) || 1;
  const scale = `dark: 0, bright: ${digits(most, 3)} ${unit}`;
  element("nodescale").textContent = scale;
  return [{
    label: `${title}, ${scale}`,
    data: run.nodes.places.map(
        ([x, y], i) => ({x, y, text: `${title} ${digits(values[i], 4)} ${unit}`})),
    pointRadius: 5,
    borderWidth: 0,
    backgroundColor: values.map((value) => rgb(colourAt(value / most)))
  }];
}

/** Periodic motions over the friction: filled where they are stable. */
function periodicSets(run) {
  const colour = css("--accent");
  const text =
      ([friction, energy, stable,
        frequency]) => [`friction ${digits(friction, 5)}`, `${digits(energy, 4)} J`,
                        `${digits(frequency, 6)} Hz`, stable ? "stable" : "unstable"]
                           .join(", ");
  return [{
    label: "periodic motion, filled: stable",
    data: run.periodic.map((motion) => ({x: motion[0], y: motion[1], text: text(motion)})),
    pointRadius: 5,
    borderColor: colour,
    borderWidth: 1.5,
    backgroundColor: run.periodic.map((motion) => (motion[2] ? colour : "transparent"))
  }];
}

/** Draws the chosen run, if there is one. */
function drawRegime() {
  const run = data.regimes[regime.run];
  if (!run || !regime.charts.cycles) return;
  element("regimesentence").textContent = run.sentence;
  const sets = {
    cycles: growthSets(run),
    spectrum: spectrumSets(run),
    nodes: nodeSets(run),
    periodic: periodicSets(run)
  };
  element("branch").hidden = !run.periodic.length;
  const spectrum = regime.charts.spectrum.options.scales,
        nodes = regime.charts.nodes.options.scales;
  spectrum.y.title.text = Object.keys(run.spectrum)[regime.line] || "";
  if (run.nodes)
    [nodes.x.title.text, nodes.y.title.text] = run.nodes.axes.map((axis) => `${axis} [mm]`);
  for (const [id, one] of Object.entries(regime.charts)) {
    colourAxes(one.options);
    one.data.datasets = sets[id];
    one.update("none");
  }
}

/** Fills a menu and redraws when another entry is chosen. */
function regimeMenu(id, titles, key) {
  element(id).replaceChildren(...titles.map((title, i) => new Option(title, i)));
  element(id).hidden = titles.length === 0;
  element(id).addEventListener("change", (event) => {
    regime[key] = Number(event.target.value);
    drawRegime();
  });
}

function makeRegime() {
  if (!data.regimes.length) return;
  element("regime").hidden = false;
  regimeChart("cycles", "time [ms]", "largest kinetic energy of a cycle [J]", true);
  regimeChart("spectrum", "frequency [kHz]", "", true);
  regimeChart("nodes", "", "", false);
  regimeChart("periodic", "friction", "largest kinetic energy [J]", false);
  const runs = data.regimes, shown = runs.find((run) => run.nodes);
  regimeMenu("regimerun", runs.map((run) => run.name), "run");
  regimeMenu("regimeline", Object.keys(runs[0].spectrum), "line");
  regimeMenu("regimefield", shown ? shown.nodes.fields.map((field) => field.title) : [], "field");
  drawRegime();
}
