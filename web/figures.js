// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Figures that can be saved: charts and maps as SVG and PNG, the view of a mode as PNG. A saved
// figure has a fixed width, a legend and the colours of the page.

const figureWidth = 960, figureScale = 2;
// By the identifier of the canvas: the words of the figure and, as width, height and a function of
// a context, its drawing.
const figures = {};

/** Offers a blob as a file. */
function offer(name, blob) {
  const link = make("a", {download: name, href: URL.createObjectURL(blob)});
  link.click();
  URL.revokeObjectURL(link.href);
}

const fileName = (id, ending) => `${data.case}_${id}.${ending}`.replace(/[^\w.-]+/g, "_");

/** Fills the background, which a canvas and SVG leave transparent. */
const paper = {
  id: "paper",
  beforeDraw(chart) {
    chart.ctx.fillStyle = css("--paper");
    chart.ctx.fillRect(0, 0, chart.width, chart.height);
  }
};

/** The legend of a saved chart: sets of data that have a name. */
const savedLegend = () => ({
  display: true,
  labels: {
    color: css("--ink"),
    usePointStyle: true,
    filter: (item, {datasets}) =>
        Boolean(datasets[item.datasetIndex].label) && !datasets[item.datasetIndex].unlisted
  }
});

const savedTitle = (text) => ({display: true, text, color: css("--ink"), font: {size: 14}});

/**
 * A copy of a chart of the size of a figure, which is not on the page. Lines with an option
 * `segment` are drawn without Path2D, which a context for SVG could not read.
 */
function copyOfChart(chart, title) {
  const canvas = document.createElement("canvas");
  canvas.width = figureWidth;
  const shape = chart.width ? chart.height / chart.width : 0.6;  // a hidden chart has no width
  canvas.height = Math.round(figureWidth * Math.max(0.4, shape));
  const {options} = chart.config;
  const segment = {borderDash: () => undefined};
  return new Chart(canvas, {
    type: chart.config.type,
    data: {
      labels: chart.data.labels,
      datasets: chart.data.datasets.map((set) => ({...set, segment})),
    },
    options: {
      ...options,
      responsive: false,
      animation: false,
      devicePixelRatio: figureScale,
      plugins: {...options.plugins, legend: savedLegend(), title: savedTitle(title)},
    },
    plugins: [paper, ...(chart.config.plugins || [])],
  });
}

function svgOfChart(chart, title) {
  const copy = copyOfChart(chart, title);
  const drawing = new SvgContext(copy.width, copy.height, title);
  for (const part of [copy, copy.legend, copy.titleBlock, ...Object.values(copy.scales)])
    part.ctx = drawing;
  for (const {controller} of copy.getSortedVisibleDatasetMetas()) controller._ctx = drawing;
  copy.draw();
  copy.destroy();
  return drawing.text();
}

function canvasOfChart(chart, title) {
  const copy = copyOfChart(chart, title), picture = document.createElement("canvas");
  copy.draw();
  [picture.width, picture.height] = [copy.canvas.width, copy.canvas.height];
  picture.getContext("2d").drawImage(copy.canvas, 0, 0);
  copy.destroy();
  return picture;
}

/** A canvas with a drawing of a function of (context, width, height). */
function canvasOfDrawing(draw, height) {
  const picture = make("canvas", {width: figureScale * figureWidth, height: figureScale * height});
  const context = picture.getContext("2d");
  context.scale(figureScale, figureScale);
  draw(context, figureWidth, height);
  return picture;
}

function svgOfDrawing(draw, height, title) {
  const drawing = new SvgContext(figureWidth, height, title);
  draw(drawing, figureWidth, height);
  return drawing.text();
}

/** Makes the buttons that save a figure: each ending with a function that returns a blob. */
function saveButtons(id, title, kinds) {
  const box = make("span", {className: "save"});
  for (const [ending, blobOf] of Object.entries(kinds)) {
    const button = make("button", {type: "button", textContent: ending.toUpperCase()});
    button.setAttribute("aria-label", `Save ${title} as ${ending.toUpperCase()}`);
    button.addEventListener("click", async () => offer(fileName(id, ending), await blobOf()));
    box.append(button);
  }
  return box;
}

const pngOf = (canvas) => new Promise((done) => canvas.toBlob(done, "image/png"));
const svgBlob = (text) => new Blob([text], {type: "image/svg+xml"});

/**
 * Adds a figure with its buttons to the frame of a canvas. `svg` and `canvas` return its forms for
 * a title; figures of the selected mode have its words in the title.
 */
function addFigure(id, svg, canvas, ofMode = false) {
  const label = element(id).getAttribute("aria-label");
  const mode = () =>
      wordsOf(state.selected).split("\n").slice(0, nameOfShape(state.selected) ? 3 : 2);
  const title = () => (ofMode ? `${label}: ${mode().join(", ")}` : label);
  figures[id] = {svg: () => svg(title()), canvas: () => canvas(title())};
  element(id).parentElement.append(saveButtons(
      id, label, {svg: () => svgBlob(figures[id].svg()), png: () => pngOf(figures[id].canvas())}));
}

/** Adds the figure of a chart. */
function addChartFigure(chart, ofMode = false) {
  addFigure(
      chart.canvas.id, (title) => svgOfChart(chart, title), (title) => canvasOfChart(chart, title),
      ofMode);
}
