// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The judged list of another program, and the proofs of the lists of a sweep.

const judged = {
  chart: null,
  faults: true
};
const judgedTable = data.judged;
// The order of the table, and the look of the entries in the diagram.
const looks = {
  missing: {pointStyle: "circle", colour: "--fault"},
  artefact: {pointStyle: "crossRot", colour: "--fault"},
  double: {pointStyle: "rectRot", colour: "--fault"},
  inexact: {pointStyle: "triangle", colour: "--fault"},
  unproved: {pointStyle: "rect", colour: "--ink"},
  right: {pointStyle: "circle", colour: "--accent"},
  outside: {pointStyle: "circle", colour: "--soft"}
};
const inHertz = (angular) => (angular === null ? null : angular / (2 * Math.PI));

/** Row i of the judged list: the place of its entry, and of the proved eigenvalue nearest to it. */
function judgedRow(i) {
  const t = judgedTable;
  return {
    entry: t.entry[i],
    verdict: t.verdict[i],
    hertz: inHertz(t.angular_frequency_rad_per_s[i]),
    growth: t.growth_rate_1_per_s[i],
    provedHertz: inHertz(t.proved_angular_frequency_rad_per_s[i]),
    provedGrowth: t.proved_growth_rate_1_per_s[i],
    radius: t.radius_rad_per_s[i],
    distance: t.distance_rad_per_s[i]
  };
}

function judgedRows() {
  const order = Object.keys(looks), place = (row) => row.hertz ?? row.provedHertz;
  return judgedTable.verdict.map((_, i) => judgedRow(i))
      .sort((a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict) || place(a) - place(b));
}

function judgedSets() {
  const rows = judgedRows();
  return Object.entries(looks)
      .map(([verdict, {pointStyle, colour}]) => ({
             label: verdict,
             data:
                 rows.filter((row) => row.verdict === verdict)
                     .map(
                         (row) => (
                             {x: row.hertz ?? row.provedHertz, y: row.growth ?? row.provedGrowth})),
             pointStyle,
             pointRadius: verdict === "right" ? 4 : 7,
             borderWidth: 2,
             borderColor: css(colour),
             backgroundColor: verdict === "missing" ? "transparent" : css(colour)
           }))
      .filter((set) => set.data.length);
}

function judgedLines() {
  const shown = judgedRows().filter((row) => !judged.faults || row.verdict !== "right");
  const head = [
    "verdict", "entry", "frequency Hz", "growth 1/s", "proved frequency Hz", "proved growth 1/s",
    "radius rad/s", "distance rad/s"
  ];
  const line = (row) =>
      [row.verdict, row.entry === null ? "" : String(row.entry), digits(row.hertz, 8),
       digits(row.growth, 6), digits(row.provedHertz, 8), digits(row.provedGrowth, 6),
       digits(row.radius, 2), digits(row.distance, 3)];
  element("judgedtable").replaceChildren(tableOf(head, shown.map(line)));
  element("judgedcount").textContent = `${shown.length} of ${judgedTable.verdict.length} rows`;
}

function drawJudged() {
  if (!judged.chart) return;
  judged.chart.data.datasets = judgedSets();
  colourAxes(judged.chart.options);
  judged.chart.options.plugins.legend.labels.color = css("--ink");
  judged.chart.update("none");
}

function makeJudged() {
  if (!judgedTable) return;
  element("judged").hidden = false;
  judged.chart = new Chart(element("judgedchart"), {
    type: "scatter",
    data: {datasets: []},
    options: {
      animation: false,
      maintainAspectRatio: false,
      plugins: {legend: {labels: {usePointStyle: true}}},
      scales: scalesOf("frequency [Hz]", "growth rate [1/s]")
    }
  });
  addChartFigure(judged.chart);
  judged.faults = judgedTable.verdict.some((verdict) => verdict !== "right");
  element("judgedfilter").value = judged.faults ? "faults" : "";
  element("judgedfilter").addEventListener("change", (event) => {
    judged.faults = event.target.value === "faults";
    judgedLines();
  });
  judgedLines();
  drawJudged();
}

/** A table of the points with a proof, or with the reason why there is none. */
function makeProofs() {
  const t = data.proof;
  if (!t || !t.complete.length) return;
  const head = ["point", "list", "eigenvalues", "up to Hz", "Re s from 1/s", "ratio", "reason"];
  const state = (i) =>
      (t.complete[i]         ? "complete" :
           t.count_proved[i] ? "number proved" :
                               "not proved");
  const edge = (i) => (t.left_1_per_s[i] === null ? "" : digits(-t.left_1_per_s[i], 4));
  const line = (_, i) =>
      [nameOfPoint(t, i), state(i), t.count_proved[i] ? digits(t.eigenvalues[i]) : "",
       digits(t.top_hz[i]), edge(i), digits(t.ratio[i], 2), t.reason[i] ?? ""];
  section("Proof of the number of eigenvalues", tableOf(head, t.complete.map(line), 2));
}
