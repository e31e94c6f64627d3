// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The selected eigenvalue, and the line of the sweep that is shown.

/** Selects an eigenvalue; done when its shape and its maps are drawn. */
function select(row) {
  state.selected = row;
  element("chosen").textContent = wordsOf(row).replaceAll("\n", " · ");
  if (lineOf(eigen, row) !== state.line) chooseLine(lineOf(eigen, row));
  drawCharts();
  drawStability();
  markRow();
  showShares();
  showChanges();
  return Promise.all([showMaps(), showShape()]);
}

/** The next mode of the same point, above (1) or below (-1); undefined at the end. */
function neighbourOfPoint(row, step) {
  const same = inLine().filter((i) => eigen[across][i] === eigen[across][row]);
  same.sort((a, b) => eigen.mode[a] - eigen.mode[b]);
  return same[same.indexOf(row) + step];
}

/**
 * The nearest eigenvalue of the next point, to the right (1) or left (-1); undefined at the end.
 */
function neighbourOfLine(row, step) {
  const list = inLine(), place = eigen[across];
  const values = [...new Set(list.map((i) => place[i]))].sort((a, b) => a - b);
  const next = values[values.indexOf(place[row]) + step];
  const there = list.filter((i) => place[i] === next);
  if (!there.length) return undefined;
  const parts = ["angular_frequency_rad_per_s", "growth_rate_1_per_s"];
  const far = (i) => Math.hypot(...parts.map((name) => eigen[name][i] - eigen[name][row]));
  return there.reduce((a, b) => (far(b) < far(a) ? b : a));
}

const neighbours = {
  ArrowUp: (row) => neighbourOfPoint(row, 1),
  ArrowDown: (row) => neighbourOfPoint(row, -1),
  ArrowRight: (row) => neighbourOfLine(row, 1),
  ArrowLeft: (row) => neighbourOfLine(row, -1),
};

/** Selects a neighbour by the arrow keys. */
function walk(event) {
  const neighbour = neighbours[event.key];
  if (!neighbour || state.selected < 0) return;
  event.preventDefault();
  const next = neighbour(state.selected);
  if (next !== undefined) select(next);
}

function chooseLine(line) {
  state.line = line;
  for (const button of element("line").querySelectorAll("button"))
    button.setAttribute("aria-pressed", String(button.dataset.line === line));
  drawCharts();
  drawStability();
}

/** The swept parameters of a line besides the one across. */
function nameOfLine(line) {
  const values = line.split(",");
  return others.map((name, k) => [name, values[k]])
      .filter(([name]) => data.swept.includes(name))
      .map((pair) => pair.join(" "))
      .join(", ");
}

/** Makes a button for each line of the sweep, if there are several. */
function makeLines() {
  if (lines.length < 2) return;
  element("line").hidden = false;
  for (const line of lines) {
    const button = make("button", {type: "button", textContent: nameOfLine(line)});
    button.dataset.line = line;
    button.addEventListener("click", () => {
      chooseLine(line);
      select(fastest(inLine()));
    });
    element("line").append(button, " ");
  }
  chooseLine(state.line);
}
