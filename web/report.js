// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Starts the report of a run. One mode is selected at a time, in the diagrams, the table and the
// view.

function setScheme(dark) {
  document.documentElement.classList.toggle("dark", dark);
  element("scheme").textContent = dark ? "Light" : "Dark";
  drawCharts();
  drawRegime();
  drawStability();
  drawJudged();
  colourBars();
  drawMaps();
  if (view.bodies) outlines();
}

/** The row that is selected at the start: the first mode with a shape, or the fastest one. */
function firstRow() {
  const shape = data.shapes[0];
  const isKept = (i) => eigen.mode[i] === shape.mode && isPointOf(shape.at, i);
  return (shape && rows.find(isKept)) ?? fastest(rows);
}

async function begin() {
  element("main").hidden = false;
  makeCharts();
  makeStability();
  makeShares();
  makeChanges();
  makeCriticalChanges();
  makeLines();
  makeTable();
  makeRegime();
  makeJudged();
  makeSections();
  element("scheme").addEventListener("click", () => {
    setScheme(!document.documentElement.classList.contains("dark"));
  });
  setScheme(matchMedia("(prefers-color-scheme: dark)").matches);
  await makeMaps();
  await makeView();
  if (rows.length) await select(firstRow());
  document.documentElement.dataset.ready = "yes";
}

begin();
