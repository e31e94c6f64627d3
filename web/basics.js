// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The data of a page, and how values and tables are written.

const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);

/** A number with n digits at most; an empty text for none. */
function digits(value, n = 6) {
  if (value === null || value === undefined) return "";
  return Number(Number(value).toPrecision(n)).toString();
}

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** A new element with properties. */
function make(tag, properties = {}) {
  return Object.assign(document.createElement(tag), properties);
}

/** A table with a head; its first columns, as many as `words`, hold words. */
function tableOf(head, body, words = 1) {
  const table = make("table"), top = table.createTHead().insertRow();
  const kind = (k) => (k < words ? "word" : "");
  head.forEach((title, k) => top.append(make("th", {textContent: title, className: kind(k)})));
  const rest = table.createTBody();
  for (const line of body) {
    const row = rest.insertRow();
    line.forEach((value, k) => {
      const cell = row.insertCell();
      cell.className = kind(k);
      cell.append(typeof value === "number" ? digits(value) : value ?? "");
    });
  }
  return table;
}
