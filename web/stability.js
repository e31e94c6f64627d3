// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The stability chart: frequency against damping ratio, with the squeal index.

const stability = {
  chart: null,
  points: "all",
  range: "near",
  beyond: 0
};
const mostListed = 500;

/** 100 · 2 Re s/|s|, per cent: positive for a growing mode; null for s = 0. */
function squealIndex(i) {
  const re = eigen.growth_rate_1_per_s[i], size = Math.hypot(re, angular(i));
  return size > 0 ? (200 * re) / size : null;
}

const angular = (i) => eigen.angular_frequency_rad_per_s[i];
const dampingOf = (i) => (squealIndex(i) === null ? 0 : -squealIndex(i) / 2);

/** The rows of the chart: those of the line, or of the point of the selected mode. */
function stabilityRows() {
  const here = (i) => eigen[across][i] === eigen[across][state.selected];
  return inLine().filter((i) => stability.points === "all" || here(i));
}

/** The damping beyond which a mode is not shown: three times that of the worst mode. */
function mostDamping(list) {
  if (stability.range === "all") return Infinity;
  const worst = Math.max(0, ...list.map((i) => -dampingOf(i)));
  return Math.max(0.1, 3 * worst);
}

/** One set of points for each value of the swept parameter, coloured by it. */
function stabilitySets(list) {
  const most = mostDamping(list), shown = list.filter((i) => Math.abs(dampingOf(i)) <= most);
  stability.beyond = list.length - shown.length;
  const values = [...new Set(list.map((i) => eigen[across][i]))].sort((a, b) => a - b);
  const point = (i) => ({x: hertz(eigen, i), y: dampingOf(i), row: i});
  const sets =
      values.map((value, k) => ({
                   label: `${across} ${digits(value)}`,
                   data: shown.filter((i) => eigen[across][i] === value).map(point),
                   backgroundColor: rgb(colourAt(0.92 * k / Math.max(1, values.length - 1))),
                   borderColor: css("--ink"),
                   borderWidth: 0.5,
                   pointRadius: (c) => (c.raw && eigen.grows[c.raw.row] ? 5 : 3),
                   pointHitRadius: 5,
                   order: 2
                 }));
  sets.push(selectedSet(shown.filter((i) => i === state.selected).map(point)));
  return sets;
}

/** Shades the unstable half, where the damping is negative. */
const unstableHalf = {
  id: "unstablehalf",
  beforeDraw(chart) {
    const {left, right, top, bottom} = chart.chartArea;
    const zero = Math.min(bottom, Math.max(top, chart.scales.y.getPixelForValue(0)));
    chart.ctx.fillStyle = css("--warn");
    chart.ctx.fillRect(left, zero, right - left, bottom - zero);
    if (bottom - zero < 16) return;
    chart.ctx.fillStyle = css("--soft");
    chart.ctx.font = "italic 12px sans-serif";
    chart.ctx.textAlign = "right";
    chart.ctx.textBaseline = "bottom";
    chart.ctx.fillText("unstable", right - 6, bottom - 4);
  }
};

/** Gives both vertical axes the same lines: the index is minus twice the damping. */
function fitStabilityAxes(list) {
  const most = mostDamping(list), values = list.map(dampingOf).filter((v) => Math.abs(v) <= most);
  const low = Math.min(0, ...values), high = Math.max(0, ...values);
  const step = roundStep(high - low || 1, 8), {y, index} = stability.chart.options.scales;
  y.min = Math.floor(low / step - 0.2) * step;
  y.max = Math.ceil(high / step + 0.2) * step;
  y.ticks.stepSize = step;
  index.min = -2 * y.max;
  index.max = -2 * y.min;
  index.ticks.stepSize = 2 * step;
}

function stabilityTable(list) {
  const places = data.parameters.filter(isShown);
  const head =
      [...places, "mode", "frequency Hz", "damping %", "squeal index %", "growth 1/s", "verdict"];
  const order = list.slice().sort((a, b) => (squealIndex(b) ?? 0) - (squealIndex(a) ?? 0));
  const shown = order.slice(0, mostListed);
  const line = (i) =>
      [...places.map((name) => digits(eigen[name][i])), eigen.mode[i], digits(hertz(eigen, i), 7),
       digits(dampingOf(i), 4), digits(squealIndex(i), 4), digits(growth(eigen, i), 5),
       eigen.verdict[i]];
  const table = tableOf(head, shown.map(line), 0);
  [...table.tBodies[0].rows].forEach((row, k) => {
    row.dataset.row = shown[k];
    row.tabIndex = 0;
    row.classList.toggle("selected", shown[k] === state.selected);
  });
  element("indices").replaceChildren(table);
  const left = order.length - shown.length;
  element("indexcount").textContent = left ? `the first ${mostListed} of ${order.length}` : "";
}

function drawStability() {
  if (!stability.chart) return;
  const list = stabilityRows();
  stability.chart.data.datasets = stabilitySets(list);
  fitStabilityAxes(list);
  colourAxes(stability.chart.options);
  stability.chart.options.plugins.legend.labels.color = css("--ink");
  stability.chart.update("none");
  element("beyond").textContent = stability.beyond ?
      `Outside of the chart, with more damping: ${stability.beyond} of ${list.length} eigenvalues` :
      "";
  stabilityTable(list);
}

function openIndex(event) {
  const row = event.target.closest("tbody tr");
  if (row && (event.type === "click" || event.key === "Enter")) select(Number(row.dataset.row));
}

/** Legends of many points name every second, third, … of them. */
function isListed(item, {datasets}) {
  if (datasets[item.datasetIndex].unlisted) return false;
  const every = Math.ceil((datasets.length - 1) / 14);
  return item.datasetIndex % every === 0;
}

function makeStability() {
  if (!rows.length) return;
  element("stability").hidden = false;
  const {x, y} = scalesOf("frequency [Hz]", "damping ratio [%]");
  const index = {
    position: "right",
    reverse: true,
    grid: {drawOnChartArea: false},
    title: {display: true, text: "squeal index 100·2 Re s/|s| [%]"}
  };
  const onClick = (_, hits) => {
    const sets = stability.chart.data.datasets;
    const point = hits.map((hit) => sets[hit.datasetIndex].data[hit.index])[0];
    if (point) select(point.row);
  };
  stability.chart = new Chart(element("damping"), {
    type: "scatter",
    data: {datasets: []},
    plugins: [unstableHalf],
    options: {
      animation: false,
      maintainAspectRatio: false,
      onClick,
      plugins: {
        legend: {labels: {usePointStyle: true, filter: isListed}},
        tooltip: {enabled: false, external: hover}
      },
      scales: {x, y, index},
    },
  });
  stability.chart.canvas.addEventListener("mouseleave", () => {
    element("hover").hidden = true;
  });
  for (const [id, key] of [["dampingpoints", "points"], ["dampingrange", "range"]])
    element(id).addEventListener("change", (event) => {
      stability[key] = event.target.value;
      drawStability();
    });
  for (const kind of ["click", "keydown"]) element("indices").addEventListener(kind, openIndex);
  addChartFigure(stability.chart);
}
