// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The table of the eigenvalues.

const exponential = (value) => (value === null ? "" : value.toExponential(1));
const percent = (value) => (value === null ? "" : digits(100 * value, 4));
// Name of the column, its title, and the text of a value.
const columns = [
  ...data.parameters.filter(isShown).map((name) => [name, name, (v) => digits(v)]),
  ["mode", "mode", String],
  ["frequency_hz", "frequency Hz", (v) => digits(v, 8)],
  ["growth_rate_1_per_s", "growth 1/s", (v) => digits(v, 6)],
  ["damping_ratio", "damping %", percent],
  ["error_estimate", "error |δs|/|s|", exponential],
  ["verdict", "verdict", String],
  ["name", "shape", (v) => v ?? ""],
].filter(([name]) => eigen[name]);
const isWord = (name) => name === "verdict" || name === "name";
const mostRows = 2000;
let listed = [];

/** Whether the row has a cell that begins with each of the words. */
function hasWords(i, words) {
  const cells = columns.map(([name, , text]) => text(eigen[name][i]).toLowerCase());
  return words.every((word) => cells.some((cell) => cell.startsWith(word)));
}

/** The rows that pass the filter and the search, in the order of the chosen column. */
function chosenRows() {
  const words = state.find.trim().toLowerCase().split(/\s+/).filter(Boolean);
  const key = eigen[state.sort], sign = state.down ? -1 : 1;
  return rows.filter((i) => !state.filter || eigen.grows[i] || isUndecided(i))
      .filter((i) => hasWords(i, words))
      .sort(
          (a, b) => sign *
                  (key[a] < key[b]     ? -1 :
                       key[a] > key[b] ? 1 :
                                         0) ||
              a - b);
}

function sortBy(name) {
  state.down = state.sort === name ? !state.down : true;
  state.sort = name;
  listRows();
}

function headCell(name, title) {
  const chosen = state.sort === name;
  const cell = make("th", {className: isWord(name) ? "word" : ""});
  const button = make("button", {type: "button", textContent: title});
  if (chosen) button.textContent += state.down ? " ▼" : " ▲";
  button.addEventListener("click", () => sortBy(name));
  cell.setAttribute("aria-sort", chosen ? (state.down ? "descending" : "ascending") : "none");
  cell.append(button);
  return cell;
}

function addRow(body, i) {
  const row = body.insertRow();
  row.dataset.row = i;
  row.tabIndex = 0;
  for (const [name, , text] of columns) {
    const cell = row.insertCell();
    cell.textContent = text(eigen[name][i]);
    if (isWord(name)) cell.className = "word";
  }
}

/** Fills the table with the chosen rows. */
function listRows() {
  listed = chosenRows();
  const head = make("thead"), body = make("tbody");
  head.insertRow().append(...columns.map(([name, title]) => headCell(name, title)));
  for (const i of listed.slice(0, mostRows)) addRow(body, i);
  element("table").replaceChildren(head, body);
  element("count").textContent = `${listed.length} of ${rows.length} eigenvalues` +
      (listed.length > mostRows ? `, the first ${mostRows} shown` : "");
  markRow();
}

function markRow() {
  for (const row of element("table").querySelectorAll("tbody tr"))
    row.classList.toggle("selected", Number(row.dataset.row) === state.selected);
}

function openRow(event) {
  const row = event.target.closest("tbody tr");
  if (row) select(Number(row.dataset.row));
}

/** Offers the listed rows as a file. */
function download() {
  const keys = Object.keys(eigen).filter((name) => name !== "grows");
  const body = listed.map((i) => keys.map((name) => eigen[name][i] ?? "").join(","));
  const text = [keys.join(","), ...body, ""].join("\n");
  offer("eigenvalues.csv", new Blob([text], {type: "text/csv"}));
}

function makeTable() {
  element("table").addEventListener("click", openRow);
  element("table").addEventListener("keydown", (event) => {
    if (event.key === "Enter" && event.target.matches("tr")) openRow(event);
  });
  element("filter").addEventListener("change", (event) => {
    state.filter = event.target.value;
    listRows();
  });
  element("find").addEventListener("input", (event) => {
    state.find = event.target.value;
    listRows();
  });
  element("download").addEventListener("click", download);
  if (!rows.some((i) => eigen.grows[i] || isUndecided(i)))
    element("filter").value = state.filter = "";
  listRows();
}
