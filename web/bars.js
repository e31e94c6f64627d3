// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Charts of horizontal bars by Chart.js, and the colours of their sets.

const barCharts = {};
const palette = [
  "#2f6db5", "#e08a1e", "#3f9b52", "#c8423b", "#8461b3", "#7d5a46", "#d077b0", "#3aa7b8", "#a9a832",
  "#20406e"
];
const otherColour = "#9aa3ad";

/** The words of a bar. */
function wordsOfBar({dataset, label, raw}) {
  const value = `${digits(raw, 4)} ${dataset.unit || ""}`.trim();
  return dataset.label ? `${dataset.label}: ${value}` : `${label}: ${value}`;
}

/** Makes a chart of bars, stacked if several sets of data have values for a bar. */
function barChart(id, title, {legend = false, ofMode = true} = {}) {
  const axis = (text) => ({stacked: true, title: {display: Boolean(text), text}});
  barCharts[id] = new Chart(element(id), {
    type: "bar",
    data: {labels: [], datasets: []},
    options: {
      indexAxis: "y",
      animation: false,
      maintainAspectRatio: false,
      plugins: {
        legend: {display: legend, labels: {boxWidth: 12}},
        tooltip: {callbacks: {label: wordsOfBar}}
      },
      scales: {x: axis(title), y: {...axis(""), ticks: {autoSkip: false}}},
    },
  });
  addChartFigure(barCharts[id], ofMode);
}

/** Fills a chart of bars; its height follows their number. */
function setBars(id, labels, datasets, range = {}) {
  const one = barCharts[id];
  const around = one.options.plugins.legend.display ? 7.5 : 4.5;  // of the bars
  one.canvas.parentElement.style.height = `${around + 1.5 * Math.max(2, labels.length)}rem`;
  one.data.labels = labels;
  one.data.datasets = datasets.map((set) => ({borderWidth: 0, maxBarThickness: 18, ...set}));
  Object.assign(one.options.scales.x, range);
  colourAxes(one.options);
  one.options.plugins.legend.labels.color = css("--ink");
  one.resize();
  one.update("none");
}

function colourBars() {
  for (const one of Object.values(barCharts)) {
    colourAxes(one.options);
    one.options.plugins.legend.labels.color = css("--ink");
    one.update("none");
  }
}
