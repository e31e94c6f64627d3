// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// Charts of points and lines as SVG, which can be saved as SVG and PNG.

const frame = {
  width: 760,
  height: 430,
  left: 84,
  right: 14,
  bottom: 48
};
const shapes = ["circle", "square", "triangle", "diamond", "down", "plus"];
// Colours of Okabe and Ito, which colour-blind people can tell apart.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#777777"];

/** A new element of SVG with attributes and content. */
function svg(tag, attributes = {}, ...content) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...content);
  return made;
}

/** The outline of a marker as a path. */
function outline(shape, x, y, r) {
  const at = (points) => `M${
      points.map(([u, v]) => `${(x + r * u).toFixed(2)} ${(y + r * v).toFixed(2)}`).join("L")}Z`;
  const t = 0.35;
  switch (shape) {
    case "square":
      return at([[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]]);
    case "triangle":
      return at([[0, -1.15], [1, 0.7], [-1, 0.7]]);
    case "down":
      return at([[0, 1.15], [1, -0.7], [-1, -0.7]]);
    case "diamond":
      return at([[0, -1.2], [1, 0], [0, 1.2], [-1, 0]]);
    case "plus":
      return at([
        [-t, -1], [t, -1], [t, -t], [1, -t], [1, t], [t, t], [t, 1], [-t, 1], [-t, t], [-1, t],
        [-1, -t], [-t, -t]
      ]);
    default:
      return `M${(x - r).toFixed(2)} ${y.toFixed(2)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${
          - 2 * r} 0Z`;
  }
}

/** Round numbers between two values, `most` of them or fewer. */
function ticks(low, high, most) {
  const rough = (high - low) / most, size = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * size).find((s) => s >= rough * (1 - 1e-9));
  const all = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    all.push(Number((k * step).toPrecision(12)));
  return all;
}

/** The smallest and the largest of some values, a little apart. */
function span(values, zero) {
  const known = values.filter(Number.isFinite);
  if (zero || !known.length) known.push(0);
  let low = known.reduce((a, b) => Math.min(a, b)), high = known.reduce((a, b) => Math.max(a, b));
  if (low === high)
    [low, high] = [low - (Math.abs(low) || 1) / 10, high + (Math.abs(high) || 1) / 10];
  const edge = 0.04 * (high - low);
  return [low - edge, high + edge];
}

/** The legend: markers and names in rows, and the height that it takes. */
function legendOf(sets) {
  const group = svg("g");
  let x = frame.left, y = 16;
  for (const set of sets) {
    const width = 30 + 7.6 * set.name.length;
    if (x > frame.left && x + width > frame.width - frame.right) [x, y] = [frame.left, y + 20];
    group.append(
        svg("path", {d: outline(set.shape, x + 7, y - 4, 5), fill: set.colour}),
        svg("text", {x: x + 18, y, fill: css("--ink")}, set.name));
    x += width;
  }
  return [group, y + 12];
}

function axes(content, box, titles) {
  const ink = css("--ink"), line = css("--line"), {left, right, top, bottom} = box;
  for (const value of ticks(...box.x, 8)) {
    const x = box.placeX(value);
    content.append(
        svg("line", {x1: x, x2: x, y1: top, y2: bottom, stroke: line}),
        svg("text", {x, y: bottom + 17, fill: ink, "text-anchor": "middle"}, digits(value)));
  }
  for (const value of ticks(...box.y, 7)) {
    const y = box.placeY(value);
    content.append(
        svg("line", {x1: left, x2: right, y1: y, y2: y, stroke: value === 0 ? ink : line}),
        svg("text", {x: left - 6, y: y + 4, fill: ink, "text-anchor": "end"}, digits(value)));
  }
  const middle = (top + bottom) / 2, turn = `rotate(-90 16 ${middle})`, style = {fill: ink};
  content.append(
      svg("text", {...style, x: (left + right) / 2, y: bottom + 38, "text-anchor": "middle"},
          titles.x),
      svg("text", {...style, x: 16, y: middle, "text-anchor": "middle", transform: turn},
          titles.y));
}

/**
 * The markers of one variant: one path for the filled ones, one for the hollow ones, one for dots.
 */
function markers(set, box) {
  const path = (points, r, shape = set.shape) =>
      points.map((p) => outline(shape, box.placeX(p.x), box.placeY(p.y), r)).join("");
  const hollow = set.points.filter((p) => p.state !== "unstable");
  const filled = set.points.filter((p) => p.state === "unstable");
  const dotted = set.points.filter((p) => p.state === "doubtful");
  const colour = {stroke: set.colour, "stroke-width": 1.2};
  return [
    svg("path", {...colour, d: path(hollow, set.size), fill: "none"}),
    svg("path", {...colour, d: path(filled, set.size), fill: set.colour, "fill-opacity": 0.75}),
    svg("path", {d: path(dotted, 1.6, "circle"), fill: set.colour}),
  ];
}

/** The lines of one variant, drawn where both ends are known. */
function linesOf(set, box) {
  const at = (p) => `${box.placeX(p.x).toFixed(2)} ${box.placeY(p.y).toFixed(2)}`;
  const d = set.lines.map((points) => `M${points.map(at).join("L")}`).join("");
  return svg("path", {d, fill: "none", stroke: set.colour, "stroke-opacity": 0.45});
}

/**
 * A chart: sets of points {x, y, state, text} and lines, with names, colours and shapes of markers.
 * `titles` has the titles of the axes, x and y, and `label`, the name of the chart.
 */
function draw(sets, titles) {
  const [legend, top] = legendOf(sets),
                 all = sets.flatMap((set) => [...set.points, ...set.lines.flat()]);
  const right = frame.width - frame.right, bottom = frame.height - frame.bottom;
  const x = span(all.map((p) => p.x)), y = span(all.map((p) => p.y), titles.zero);
  const box = {left: frame.left, right, top, bottom, x, y};
  box.placeX = (value) => box.left + (value - x[0]) / (x[1] - x[0]) * (right - box.left);
  box.placeY = (value) => bottom - (value - y[0]) / (y[1] - y[0]) * (bottom - top);
  const picture = svg("svg", {
    viewBox: `0 0 ${frame.width} ${frame.height}`,
    role: "img",
    "aria-label": titles.label,
    "font-family": "sans-serif",
    "font-size": 13
  });
  picture.append(
      svg("title", {}, titles.label),
      svg("rect", {width: frame.width, height: frame.height, fill: css("--paper")}));
  axes(picture, box, titles);
  picture.append(legend, ...sets.flatMap((set) => [linesOf(set, box), ...markers(set, box)]));
  picture.places = sets.flatMap(
      (set) => set.points.map((p) => ({x: box.placeX(p.x), y: box.placeY(p.y), text: p.text})));
  return picture;
}

/** The words of the point under the pointer; none if it is far from all. */
function wordsAt(picture, event) {
  const area = picture.getBoundingClientRect(), scale = frame.width / area.width;
  const x = (event.clientX - area.left) * scale, y = (event.clientY - area.top) * scale;
  const far = (p) => Math.hypot(p.x - x, p.y - y);
  const near = picture.places.filter((p) => far(p) < 9);
  return near.length ? near.reduce((a, b) => (far(b) < far(a) ? b : a)).text : "";
}

/** A picture as the text of a file of its own. */
function textOf(picture) {
  const copy = picture.cloneNode(true);
  copy.setAttribute("width", frame.width);
  copy.setAttribute("height", frame.height);
  return new XMLSerializer().serializeToString(copy);
}

/** A picture as a PNG of twice the size. */
async function imageOf(picture) {
  const address = URL.createObjectURL(new Blob([textOf(picture)], {type: "image/svg+xml"}));
  try {
    const image = make("img", {src: address});
    await image.decode();
    const canvas = make("canvas", {width: 2 * frame.width, height: 2 * frame.height});
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done) => canvas.toBlob(done, "image/png"));
  } finally {
    URL.revokeObjectURL(address);
  }
}

function save(blob, name) {
  const link = make("a", {download: name, href: URL.createObjectURL(blob)});
  link.click();
  URL.revokeObjectURL(link.href);
}

const saveSvg = (picture, name) =>
    save(new Blob([textOf(picture)], {type: "image/svg+xml"}), `${name}.svg`);
const savePng = async (picture, name) => save(await imageOf(picture), `${name}.png`);
