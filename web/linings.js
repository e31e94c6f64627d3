// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Contact pressure, gap and friction work as maps on the flat interfaces, seen from the disc.

const maps2d = {
  faces: [],     // the interfaces with their arrays
  touching: 0,   // number of contact nodes
  steady: null,  // pressure and gap by point and contact node
  work: null,    // friction work of the selected mode by contact node
  asked: 0
};
const bands = 12;
// The title, the unit, and larger units with their factors.
const mapFields = {
  pressure: ["contact pressure", "Pa", [[1e6, "MPa"], [1e3, "kPa"]]],
  gap: ["gap", "m", [[1e-3, "mm"], [1e-6, "µm"]]],
  work: ["friction work of the mode", "1/(s m²)", []],
};

/** From blue over white to red. */
function divergingAt(share) {
  const ends = [[33, 84, 160], [247, 247, 247], [178, 34, 44]],
        place = 2 * Math.min(1, Math.max(0, share));
  const k = Math.min(1, Math.floor(place));
  return ends[k].map((value, d) => Math.round(value + (place - k) * (ends[k + 1][d] - value)));
}

const bandColour = (name, k) => {
  const share = (k + 0.5) / bands;
  return rgb(name === "work" ? divergingAt(share) : colourAt(share));
};

/** The values of a field on an interface by its nodes; null if there are none. */
function mapValues(face, name) {
  const n = maps2d.touching;
  if (name === "work") return maps2d.work && Array.from(face.nodes, (k) => maps2d.work[k]);
  const point = data.skin.steady.findIndex((values) => isPointOf(values, state.selected));
  if (point < 0) return null;
  const first = (2 * point + (name === "gap" ? 1 : 0)) * n;
  return Array.from(face.nodes, (k) => maps2d.steady[first + k]);
}

/** The part of a convex polygon of points [x, y, value] with sign · value ≥ sign · level. */
function cutAt(polygon, level, sign) {
  const kept = [];
  polygon.forEach((p, i) => {
    const q = polygon[(i + 1) % polygon.length], a = sign * (p[2] - level),
          b = sign * (q[2] - level);
    if (a >= 0) kept.push(p);
    if (a * b < 0) kept.push(p.map((value, d) => value + (a / (a - b)) * (q[d] - value)));
  });
  return kept;
}

/** Draws the part of the field in band k as one area. */
function drawBand(context, polygons, [low, high], colour) {
  context.beginPath();
  for (const polygon of polygons) {
    const part = cutAt(cutAt(polygon, low, 1), high, -1);
    if (part.length < 3) continue;
    part.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.closePath();
  }
  context.fillStyle = context.strokeStyle = colour;
  context.lineWidth = 0.6;  // otherwise the paper shines through between triangles
  context.fill();
  context.stroke();
}

/** Draws the edges that belong to one triangle only. */
function drawRim(context, triangles, place) {
  const seen = new Map();
  for (let i = 0; i < triangles.length; i += 3)
    for (const [a, b] of [[0, 1], [1, 2], [2, 0]]) {
      const ends = [triangles[i + a], triangles[i + b]],
            key = ends.slice().sort((p, q) => p - q).join(" ");
      seen.has(key) ? seen.delete(key) : seen.set(key, ends);
    }
  context.beginPath();
  for (const [a, b] of seen.values()) {
    context.moveTo(...place(a));
    context.lineTo(...place(b));
  }
  context.strokeStyle = css("--ink");
  context.lineWidth = 1;
  context.stroke();
}

/** Where the map lies in a frame, and the scale: pixels per metre. */
function layout(face, width, height) {
  const [left, right, top, bottom] = [58, 118, 30, 42];
  const xs = face.places.filter((_, k) => k % 2 === 0), ys = face.places.filter((_, k) => k % 2);
  const ends = (values) =>
      [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
  const [x0, x1] = ends(xs), [y0, y1] = ends(ys);
  const scale = Math.min((width - left - right) / (x1 - x0), (height - top - bottom) / (y1 - y0));
  const place = (k) =>
      [left + scale * (face.places[2 * k] - x0),
       height - bottom - scale * (face.places[2 * k + 1] - y0)];
  return {
    left,
    bottom: height - bottom,
    right: left + scale * (x1 - x0),
    top: height - bottom - scale * (y1 - y0),
    scale,
    place
  };
}

function writeText(context, text, x, y, align = "left", baseline = "middle") {
  context.font = "12px sans-serif";
  context.fillStyle = css("--ink");
  context.textAlign = align;
  context.textBaseline = baseline;
  context.fillText(text, x, y);
}

/** Draws axes in mm from the lower left corner of the map. */
function drawAxes(context, {left, right, top, bottom, scale}) {
  context.strokeStyle = css("--soft");
  context.lineWidth = 1;
  context.beginPath();
  const ends = [(right - left) / scale, (bottom - top) / scale];
  ends.forEach((length, d) => {
    const step = roundStep(length, d ? 4 : 6);
    for (let k = 0; k * step <= length * (1 + 1e-9); ++k) {
      const at = k * step * scale, text = digits(1e3 * k * step, 6);
      const [x, y] = d ? [left - 6, bottom - at] : [left + at, bottom + 6];
      context.moveTo(x, y);
      context.lineTo(x + (d ? 5 : 0), y - (d ? 0 : 5));
      writeText(
          context, text, d ? x - 3 : x, d ? y : y + 3, d ? "right" : "center",
          d ? "middle" : "top");
    }
  });
  context.stroke();
  writeText(context, "mm", right + 8, bottom + 6, "left", "top");
}

/** Draws the scale of the colours with its numbers and its unit. */
function drawBandScale(context, name, [low, high], {left, top, height}) {
  const [factor, unit] = unitOf(name, Math.max(Math.abs(low), Math.abs(high)));
  const size = height / bands;
  for (let k = 0; k < bands; ++k) {
    context.fillStyle = bandColour(name, k);
    context.fillRect(left, top + height - (k + 1) * size, 14, size + 0.3);
  }
  for (let k = 0; k <= bands; k += 3)
    writeText(
        context, digits((low + (k / bands) * (high - low)) / factor, 3), left + 20,
        top + height - k * size);
  writeText(context, unit, left, top - 14, "left");
}

function unitOf(name, most) {
  const [, unit, larger] = mapFields[name];
  return larger.find(([factor]) => most >= 0.5 * factor) || [1, unit];
}

/** Draws an arrow along the friction force on this side. */
function drawArrow(context, face, {left}) {
  if (!face.friction) return;
  const [dx, dy] = face.friction, x = left + 16, y = 14, h = 11;
  context.strokeStyle = css("--ink");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x - h * dx, y + h * dy);
  context.lineTo(x + h * dx, y - h * dy);
  for (const turn of [2.6, -2.6]) {
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    context.moveTo(x + h * dx, y - h * dy);
    context.lineTo(x + h * dx + 7 * (c * dx - s * dy), y - h * dy - 7 * (s * dx + c * dy));
  }
  context.stroke();
  writeText(context, "friction on this side", left + 34, y);
}

/** Draws the map of a field on an interface. */
function drawMap(context, width, height, face, name, range) {
  context.fillStyle = css("--paper");
  context.fillRect(0, 0, width, height);
  const frame = layout(face, width, height), found = mapValues(face, name);
  drawArrow(context, face, frame);
  writeText(context, face.name, frame.right, 14, "right");
  if (!found) {
    writeText(context, "not stored for this mode", frame.left + 10, height / 2);
    drawRim(context, face.triangles, frame.place);
    return;
  }
  const values = found.map((value) => Math.min(range[1], Math.max(range[0], value)));
  const polygons = [];
  for (let i = 0; i < face.triangles.length; i += 3)
    polygons.push([0, 1, 2].map(
        (c) => [...frame.place(face.triangles[i + c]), values[face.triangles[i + c]]]));
  const level = (k) => range[0] + (k / bands) * (range[1] - range[0]);
  for (let k = 0; k < bands; ++k)
    drawBand(context, polygons, [level(k), level(k + 1)], bandColour(name, k));
  drawRim(context, face.triangles, frame.place);
  drawAxes(context, frame);
  drawBandScale(context, name, range, {left: width - 96, top: 44, height: height - 86});
}

const chosenField = () => element("mapfield").value;
const chosenFaces = () => {
  const name = element("mapface").value;
  return maps2d.faces.filter((face) => (name === "" ? face.sliding : face.name === name));
};

/** The range of a field on all interfaces that are shown. */
function mapRange(faces, name) {
  const all = faces.flatMap((face) => mapValues(face, name) || []);
  let high = all.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  const low = name === "work" ? -high : all.reduce((a, b) => Math.min(a, b), 0);
  if (name !== "work") high = all.reduce((a, b) => Math.max(a, b), 0);
  if (!(high > low)) return [low, low + 1];
  return [Math.abs(low) < 1e-9 * high ? 0 : low, high];  // below is round-off
}

function fitMap(canvas, draw) {
  const {clientWidth, clientHeight} = canvas, ratio = Math.max(2, devicePixelRatio);
  if (!clientWidth) return;
  [canvas.width, canvas.height] = [ratio * clientWidth, ratio * clientHeight];
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  draw(context, clientWidth, clientHeight);
}

/** The table of the maps: mean and largest value, then the nodes. */
function tableOfMaps(faces, name) {
  const [title, unit] = mapFields[name];
  const body = faces.flatMap((face) => {
    const values = mapValues(face, name) || [],
          at = (k, d) => digits(1e3 * face.places[2 * k + d], 4);
    return values.map((value, k) => [face.name, at(k, 0), at(k, 1), digits(value, 4)]);
  });
  const shown = body.slice(0, mostListed);
  element("maptable")
      .replaceChildren(tableOf(["interface", "x mm", "y mm", `${title} ${unit}`], shown));
  element("mapcount").textContent =
      body.length > shown.length ? `the first ${shown.length} of ${body.length} nodes` : "";
}

function drawMaps() {
  if (!maps2d.faces.length) return;
  const name = chosenField(), faces = chosenFaces(), range = mapRange(faces, name);
  maps2d.faces.forEach((face) => {
    face.draw = (context, width, height) => drawMap(context, width, height, face, name, range);
    face.canvas.parentElement.hidden = !faces.includes(face);
    if (faces.includes(face)) fitMap(face.canvas, face.draw);
  });
  const point = nameOfPoint(eigen, state.selected);
  element("mapwords").textContent = name === "work" ?
      `Mode ${eigen.mode[state.selected]} at ${
          point}. Red: friction feeds the mode; blue: it takes energy.` :
      `Steady sliding at ${point}.`;
  tableOfMaps(faces, name);
}

/** Shows the maps for the selected mode. */
async function showMaps() {
  if (!maps2d.faces.length) return;
  const asked = ++maps2d.asked, shape = shapeOf(state.selected);
  const work = shape && shape.work ? new Float32Array(await bytes(shape.work)) : null;
  if (asked !== maps2d.asked) return;
  maps2d.work = work;
  drawMaps();
}

function addFace(face, k) {
  const frame = make("div", {className: "chart map"}), canvas = make("canvas", {id: `map${k}`});
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `Map on ${face.name}, seen from the disc`);
  frame.append(canvas);
  element("maps").append(frame);
  face.canvas = canvas;
  const height = 520;
  addFigure(
      canvas.id, (title) => svgOfDrawing(face.draw, height, title),
      () => canvasOfDrawing(face.draw, height));
}

async function makeMaps() {
  if (!data.linings.length || typeof DecompressionStream === "undefined") return;
  element("linings").hidden = false;
  maps2d.touching = data.skin.touching;
  maps2d.steady = new Float32Array(await bytes("steady"));
  for (const [k, lining] of data.linings.entries()) {
    const places = new Float32Array(await bytes(`${lining.blob}places`));
    const nodes = new Uint32Array(await bytes(`${lining.blob}nodes`));
    const triangles = new Uint32Array(await bytes(`${lining.blob}triangles`));
    maps2d.faces.push({...lining, places, nodes, triangles});
    addFace(maps2d.faces[k], k);
  }
  const sliding = data.linings.some((lining) => lining.sliding);
  const names = data.linings.map((lining) => new Option(lining.name, lining.name));
  element("mapface").replaceChildren(
      ...(sliding ? [new Option("all that slide", "")] : []), ...names);
  const titles = Object.entries(mapFields).map(([name, [title]]) => new Option(title, name));
  element("mapfield").replaceChildren(...titles);
  for (const id of ["mapface", "mapfield"]) element(id).addEventListener("change", drawMaps);
  new ResizeObserver(drawMaps).observe(element("maps"));
}
