// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// What is selected, and how eigenvalues are written.

const eigen = data.eigenvalues;
const rows = eigen.mode.map((_, i) => i);

// The diagrams show one line of the sweep at a time: over the parameter `across`, at fixed values
// of the others. Buttons choose the line.
const across =
    data.swept.includes("friction") || data.swept.length === 0 ? "friction" : data.swept[0];
const others = data.parameters.filter((name) => name !== across);
const isShown = (name) => name === across || data.swept.includes(name);
const lineOf = (table, i) => others.map((name) => table[name][i]).join(",");
const lines = [...new Set(rows.map((i) => lineOf(eigen, i)))];
const state = {
  line: lines[0],
  selected: -1,
  view: "sweep",
  filter: "unstable",
  find: "",
  sort: "growth_rate_1_per_s",
  down: true
};

/** The rows of the eigenvalues on the line that is shown. */
const inLine = () => rows.filter((i) => lineOf(eigen, i) === state.line);

const isUndecided = (i) => eigen.verdict[i] === "undecided";

/** The fastest growing eigenvalue of a list of rows. */
function fastest(list) {
  const growthOf = eigen.growth_rate_1_per_s;
  return list.reduce((a, b) => (growthOf[b] > growthOf[a] ? b : a));
}

/** The shown parameters of a point whose values are in the order of data.parameters. */
function nameOfValues(values, text = digits) {
  return data.parameters.map((name, k) => [name, values[k]])
      .filter(([name]) => isShown(name))
      .map(([name, value]) => `${name} ${text(value)}`)
      .join(", ");
}

function nameOfPoint(table, i) {
  return nameOfValues(data.parameters.map((name) => table[name][i]));
}

/** Whether a point, with values in the order of data.parameters, is that of an eigenvalue. */
function isPointOf(values, row) {
  return data.parameters.every((name, k) => values[k] === eigen[name][row]);
}

/** The name of the shape of a mode, if it has one. */
const nameOfShape = (i) => (eigen.name && eigen.name[i]) || "";

/** An eigenvalue in words, one line for each property. */
function wordsOf(i) {
  const damping = eigen.damping_ratio[i];
  const error = eigen.error_estimate ? eigen.error_estimate[i] : null;
  return [
    `mode ${eigen.mode[i]} at ${nameOfPoint(eigen, i)}`,
    `${digits(eigen.frequency_hz[i], 8)} Hz`,
    ...(nameOfShape(i) ? [nameOfShape(i)] : []),
    `growth ${digits(eigen.growth_rate_1_per_s[i], 6)} 1/s`,
    `damping ${damping === null ? "unknown" : `${digits(100 * damping, 4)} %`}`,
    `error |δs|/|s| ${error === null ? "unknown" : error.toExponential(1)}`,
    eigen.verdict[i],
  ].join("\n");
}

/** The error of a critical friction in words. */
function errorOf(critical, i) {
  const error = critical.friction_error_estimate ? critical.friction_error_estimate[i] : null;
  const words = error === null ? "?" : error.toExponential(1);
  if (!critical.converged || critical.converged[i]) return words;
  return `${words}, not solved for: between points of the sweep`;
}

/** A round step that divides a length into about n parts. */
function roundStep(length, n) {
  const raw = length / n, power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
}

/** One of the 32 colours, for a share between 0 and 1. */
function colourAt(share) {
  return data.colours[Math.min(31, Math.max(0, Math.floor(32 * share)))];
}

/** The colour of a growth rate: the darkest for the largest one. */
function colourOfGrowth(value, most) {
  return data.colours[Math.min(31, Math.max(0, Math.round(31 * (1 - value / most))))];
}

const rgb = (colour) => `rgb(${colour.join(",")})`;
