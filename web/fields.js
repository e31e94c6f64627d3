// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The fields that colour the shape.

// Title and unit.
const fields = {
  amplitude: ["amplitude", "relative"],
  work: ["friction work of the mode", "1/(s m²)"],
  pressure: ["contact pressure", "Pa"],
  gap: ["gap", "m"],
};
const isSteady = (name) => name === "pressure" || name === "gap";

/** The amplitude of each node, relative to the largest one. */
function amplitudes(parts) {
  const values = new Float32Array(parts.length / 6);
  for (let i = 0; i < values.length; ++i) {
    let sum = 0;
    for (let d = 0; d < 6; ++d) sum += parts[6 * i + d] ** 2;
    values[i] = Math.sqrt(sum);
  }
  const most = values.reduce((a, b) => Math.max(a, b), 0) || 1;
  return values.map((value) => value / most);
}

/** The values of a field by contact node, of the amplitude by node; null if there are none. */
function fieldValues(name) {
  if (name === "amplitude") return view.parts && amplitudes(view.parts);
  if (name === "work") return view.work;
  if (!data.skin.steady.length) return null;
  const n = view.touching.length, point = Number(element("point").value);
  const first = (2 * point + (name === "gap" ? 1 : 0)) * n;
  return view.steady.subarray(first, first + n);
}

/** Fills the menu with the fields that the mode has. */
function listFields() {
  const menu = element("field"), chosen = menu.value;
  const present = Object.keys(fields).filter((name) => (fieldValues(name) || []).length);
  menu.replaceChildren(...present.map((name) => new Option(fields[name][0], name)));
  if (present.includes(chosen)) menu.value = chosen;
}

/** The ends of the scale of a field. The middle of the scale of the work is zero. */
function rangeOf(name, values) {
  let low = values.reduce((a, b) => Math.min(a, b), 0);
  let high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (name === "work") {
    high = Math.max(high, -low);
    low = -high;
  }
  return [low, high > low ? high : low + 1];
}

/** Draws the scale beside the shape. */
function drawScale(name, low, high) {
  const [title, unit] = fields[name], bar = make("i");
  bar.style.background = `linear-gradient(to top, ${data.colours.map(rgb).join(",")})`;
  element("scale").replaceChildren(
      `${title} [${unit}]`, make("br"), digits(high, 3), bar, digits(low, 3));
}

/** Colours the nodes by the values of a field. */
function paint(name, values, low, high) {
  const node = name === "amplitude" ? (k) => k : (k) => view.touching[k];
  values.forEach((value, k) => {
    const share = colourAt((value - low) / (high - low)).map((c) => c / 255);
    view.colours.set(share, 3 * node(k));
  });
}

/** Colours the shape by the field that is chosen. */
function colour() {
  const name = element("field").value, values = fieldValues(name);
  element("at").hidden = !isSteady(name);
  if (isSteady(name))
    element("pointname").textContent =
        nameOfValues(data.skin.steady[Number(element("point").value)]);
  const grey = [0.62, 0.65, 0.68];
  for (let i = 0; i < view.colours.length; i += 3) view.colours.set(grey, i);
  element("scale").hidden = !values;
  if (values) {
    const [low, high] = rangeOf(name, values);
    paint(name, values, low, high);
    drawScale(name, low, high);
  }
  for (const {mesh} of view.bodies) mesh.geometry.attributes.color.needsUpdate = true;
  render();
}
