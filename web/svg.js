// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// A drawing context like that of a canvas, which writes SVG. Chart.js and the maps draw on it.

const svgSpace = "http://www.w3.org/2000/svg";
const round = (value) => Number(value.toFixed(2));

/** A colour as SVG 1.1 has it: the colour without transparency, and the opacity. */
function opaqueColour(colour) {
  const probe = opaqueColour.probe ||= document.createElement("canvas").getContext("2d");
  probe.fillStyle = "#000";
  probe.fillStyle = colour;
  const parts = /^rgba\((\d+), (\d+), (\d+), ([\d.]+)\)$/.exec(probe.fillStyle);
  return parts ? [`rgb(${parts.slice(1, 4).join(",")})`, parts[4]] : [probe.fillStyle, "1"];
}

/** The product of two transformations [a, b, c, d, e, f]. */
function composed([a, b, c, d, e, f], [p, q, r, s, t, u]) {
  return [
    a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f
  ];
}

const initialStyle = {
  fillStyle: "#000",
  strokeStyle: "#000",
  lineWidth: 1,
  lineCap: "butt",
  lineJoin: "miter",
  font: "10px sans-serif",
  textAlign: "start",
  textBaseline: "alphabetic",
};
// Place of the baseline below the given one, in units of the size of the font.
const below = {
  middle: 0.35,
  top: 0.8,
  hanging: 0.8,
  bottom: -0.2
};
const anchors = {
  center: "middle",
  right: "end",
  end: "end"
};

class SvgContext {
  constructor(width, height, title) {
    this.root = this.element("svg", {width, height, viewBox: `0 0 ${width} ${height}`});
    this.root.append(this.element("title"));
    this.root.firstChild.textContent = title;
    this.canvas = {width, height};
    Object.assign(this, initialStyle);
    this.matrix = [1, 0, 0, 1, 0, 0];
    this.dash = [];
    this.clipped = null;
    this.stack = [];
    this.path = "";
    this.clips = 0;
  }

  element(name, attributes = {}) {
    const made = document.createElementNS(svgSpace, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  }

  text() {
    return new XMLSerializer().serializeToString(this.root);
  }

  save() {
    const {matrix, dash, clipped} = this;
    const style = Object.fromEntries(Object.keys(initialStyle).map((key) => [key, this[key]]));
    this.stack.push({...style, matrix, dash, clipped});
  }
  restore() {
    Object.assign(this, this.stack.pop());
  }

  translate(x, y) {
    this.matrix = composed(this.matrix, [1, 0, 0, 1, x, y]);
  }
  rotate(angle) {
    const c = Math.cos(angle), s = Math.sin(angle);
    this.matrix = composed(this.matrix, [c, s, -s, c, 0, 0]);
  }
  resetTransform() {
    this.matrix = [1, 0, 0, 1, 0, 0];
  }
  setLineDash(dash) {
    this.dash = dash;
  }

  /** The point of the drawing at x, y, as text. */
  at(x, y) {
    const [a, b, c, d, e, f] = this.matrix;
    return `${round(a * x + c * y + e)} ${round(b * x + d * y + f)}`;
  }
  beginPath() {
    this.path = "";
  }
  closePath() {
    if (this.path) this.path += "Z";
  }
  moveTo(x, y) {
    this.path += `M${this.at(x, y)}`;
  }
  lineTo(x, y) {
    this.path += `${this.path ? "L" : "M"}${this.at(x, y)}`;
  }
  bezierCurveTo(a, b, c, d, x, y) {
    this.path += `C${this.at(a, b)} ${this.at(c, d)} ${this.at(x, y)}`;
  }
  rect(x, y, width, height) {
    this.moveTo(x, y);
    this.lineTo(x + width, y);
    this.lineTo(x + width, y + height);
    this.lineTo(x, y + height);
    this.closePath();
  }
  /** SVG draws no whole circle as one arc. */
  arc(x, y, r, from, to, backwards = false) {
    const turn = to - from, halves = Math.abs(turn) > Math.PI ? 2 : 1;
    const place = (angle) => this.at(x + r * Math.cos(angle), y + r * Math.sin(angle));
    this.path += `${this.path && !this.path.endsWith("Z") ? "L" : "M"}${place(from)}`;
    for (let k = 1; k <= halves; ++k)
      this.path +=
          `A${round(r)} ${round(r)} 0 0 ${backwards ? 0 : 1} ${place(from + (turn * k) / halves)}`;
  }
  clip() {
    const id = `clip${++this.clips}`, frame = this.element("clipPath", {id});
    frame.append(this.element("path", {d: this.path}));
    this.root.append(frame);
    this.clipped = id;
  }

  /** Adds an element with the colours of the context. */
  draw(made, fill, stroke) {
    const [inside, opacity] = fill ? opaqueColour(fill) : ["none", "1"];
    made.setAttribute("fill", inside);
    if (opacity !== "1") made.setAttribute("fill-opacity", opacity);
    if (stroke) {
      const [line, visible] = opaqueColour(stroke);
      const attributes = {"stroke": line, "stroke-width": round(this.lineWidth)};
      if (visible !== "1") attributes["stroke-opacity"] = visible;
      if (this.dash.length) attributes["stroke-dasharray"] = this.dash.join(" ");
      if (this.lineCap !== "butt") attributes["stroke-linecap"] = this.lineCap;
      if (this.lineJoin !== "miter") attributes["stroke-linejoin"] = this.lineJoin;
      for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    }
    if (!this.clipped) {
      this.root.append(made);
      return;
    }
    // A clip path on the element itself would have its transformation.
    const frame = this.element("g", {"clip-path": `url(#${this.clipped})`});
    frame.append(made);
    this.root.append(frame);
  }
  fill(rule) {
    if (!this.path || opaqueColour(this.fillStyle)[1] === "0") return;
    const shape = this.element("path", {d: this.path});
    if (rule === "evenodd") shape.setAttribute("fill-rule", rule);
    this.draw(shape, this.fillStyle, null);
  }
  stroke() {
    if (!this.path || opaqueColour(this.strokeStyle)[1] === "0") return;
    this.draw(this.element("path", {d: this.path}), null, this.strokeStyle);
  }
  fillRect(x, y, width, height) {
    const {path} = this;
    this.path = "";
    this.rect(x, y, width, height);
    this.fill();
    this.path = path;
  }
  strokeRect(x, y, width, height) {
    const {path} = this;
    this.path = "";
    this.rect(x, y, width, height);
    this.stroke();
    this.path = path;
  }
  clearRect() {}

  fillText(text, x, y) {
    const size = Number(/([\d.]+)px/.exec(this.font)[1]);
    const words = this.element("text", {
      "x": round(x),
      "y": round(y + size * (below[this.textBaseline] || 0)),
      "font-family": "Helvetica, Arial, sans-serif",
      "font-size": size,
      "text-anchor": anchors[this.textAlign] || "start"
    });
    if (/\bbold\b|\b[6-9]00\b/.test(this.font)) words.setAttribute("font-weight", "bold");
    words.setAttribute("transform", `matrix(${this.matrix.map((v) => Number(v.toFixed(5)))})`);
    words.textContent = text;
    this.draw(words, this.fillStyle, null);
  }
  measureText(text) {
    const probe = SvgContext.probe ||= document.createElement("canvas").getContext("2d");
    probe.font = this.font;
    return probe.measureText(text);
  }
}
