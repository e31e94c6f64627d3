// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The shape of the selected mode by three.js, which moves with the phase.

const view = {
  phase: 0,
  playing: !matchMedia("(prefers-reduced-motion: reduce)").matches,
  bodies: null,
  parts: null,
  asked: 0,
  last: 0,
  held: false,  // nothing is drawn for the time being
};

/** The bytes that the file holds under a name. */
async function bytes(name) {
  const packed = Uint8Array.from(atob(element(`blob-${name}`).textContent), (c) => c.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(unpacked).arrayBuffer();
}

/**
 * Why this browser cannot draw shapes; null if it can. An error of three.js would end the script,
 * and with it tables and diagrams.
 */
function whyNoShapes() {
  const probe = document.createElement("canvas");
  if (!probe.getContext("webgl2") && !probe.getContext("webgl"))
    return "this browser offers no WebGL: it is turned off, or has no driver here";
  if (typeof DecompressionStream === "undefined")
    return "this browser is too old to unpack them (it has no DecompressionStream)";
  return null;
}

/** Replaces the view by the reason why no shape is drawn. */
function withoutView(why) {
  const note = make("p", {id: "noview", className: "note"});
  note.setAttribute("role", "status");
  note.textContent =
      `The shapes of the modes are not drawn: ${why}. Diagrams and tables are complete.`;
  element("view").replaceWith(note);
  document.querySelector("#shape .controls").remove();
  view.bodies = null;
}

async function makeView() {
  if (!data.skin) {
    element("view").remove();
    document.querySelector("#shape .controls").remove();
    return;
  }
  let why = whyNoShapes();
  if (!why) {
    try {
      await fillView(data.skin);
    } catch (error) {
      why = error.message;
    }
  }
  if (why) withoutView(why);
}

async function fillView(skin) {
  const triangles = new Uint32Array(await bytes("triangles"));
  const edges = new Uint32Array(await bytes("lines"));
  view.rest = Float32Array.from(new Int16Array(await bytes("places")), (v) => v / 65534);
  view.places = view.rest.slice();
  view.colours = new Float32Array(view.rest.length);
  view.touching = new Uint32Array(await bytes("touching"));
  view.steady = new Float32Array(await bytes("steady"));
  makeRenderer();
  makeScene();
  view.bodies = skin.bodies.map((body) => bodyOf(body, triangles, edges));
  makeBodies();
  element("point").max = Math.max(0, skin.steady.length - 1);
  listenToControls();
  play(view.playing);
  fit();
}

function makeRenderer() {
  const canvas = element("canvas");
  view.renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
  view.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  canvas.addEventListener("webglcontextlost", () => {
    play(false);
    withoutView("the browser has taken WebGL away from this page; load it again");
  });
}

function makeScene() {
  view.scene = new THREE.Scene();
  view.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 20);
  view.camera.up.set(0, 0, 1);
  view.camera.position.set(1.1, -1.35, 1.05);
  view.controls = new THREE.OrbitControls(view.camera, element("canvas"));
  view.controls.addEventListener("change", render);
  view.scene.add(new THREE.HemisphereLight(0xffffff, 0x777788, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.5);
  lamp.position.set(1, -2, 3);
  view.scene.add(lamp);
}

/** Part of an array of indices, counted from the first node of a body. */
function indicesFrom(array, from, to, firstNode) {
  return new THREE.BufferAttribute(array.subarray(from, to).map((i) => i - firstNode), 1);
}

/** Adds a body to the scene: its surface, and its edges at rest. */
function bodyOf(body, triangles, edges) {
  const [first, last] = body.nodes;
  const part = (all) => new THREE.BufferAttribute(all.subarray(3 * first, 3 * last), 3);
  const surface = new THREE.BufferGeometry(), still = new THREE.BufferGeometry();
  surface.setAttribute("position", part(view.places));
  surface.setAttribute("color", part(view.colours));
  const [from, to] = body.triangles, [fromLine, toLine] = body.lines;
  surface.setIndex(indicesFrom(triangles, 3 * from, 3 * to, first));
  still.setAttribute("position", part(view.rest));
  still.setIndex(indicesFrom(edges, 2 * fromLine, 2 * toLine, first));
  const mesh = new THREE.Mesh(surface, new THREE.MeshPhongMaterial({
    vertexColors: THREE.VertexColors,
    flatShading: true,
    side: THREE.DoubleSide,
    shininess: 8
  }));
  const line = new THREE.LineBasicMaterial({transparent: true, opacity: 0.45});
  const outline = new THREE.LineSegments(still, line);
  mesh.frustumCulled = outline.frustumCulled = false;
  view.scene.add(mesh, outline);
  return {mesh, outline};
}

function listenToControls() {
  element("point").addEventListener("input", colour);
  element("field").addEventListener("change", colour);
  element("outline").addEventListener("change", outlines);
  element("amplitude").addEventListener("input", move);
  element("phase").addEventListener("input", () => {
    play(false);
    view.phase = (element("phase").value * Math.PI) / 180;
    move();
  });
  element("play").addEventListener("click", () => play(!view.playing));
  new ResizeObserver(fit).observe(element("view"));
}

function fit() {
  if (!view.bodies) return;  // WebGL is lost
  const {clientWidth, clientHeight} = element("view");
  view.renderer.setSize(clientWidth, clientHeight, false);
  view.camera.aspect = clientWidth / clientHeight;
  view.camera.updateProjectionMatrix();
  render();
}

function render() {
  if (view.held) return;
  view.scene.background = new THREE.Color(css("--paper"));
  view.renderer.render(view.scene, view.camera);
}

function outlines() {
  for (const {mesh, outline} of view.bodies) {
    outline.visible = mesh.visible && element("outline").checked;
    outline.material.color.set(css("--soft"));
  }
  render();
}

function play(playing) {
  view.playing = playing;
  element("play").textContent = playing ? "Pause" : "Play";
  element("play").setAttribute("aria-pressed", String(playing));
  if (playing) requestAnimationFrame(turn);
}

/** Moves the phase on, by half a turn in a second. */
function turn(time) {
  if (!view.playing) return;
  const seconds = Math.min(0.1, (time - view.last) / 1000);
  view.phase = (view.phase + seconds * Math.PI) % (2 * Math.PI);
  view.last = time;
  element("phase").value = Math.round((view.phase * 180) / Math.PI);
  move();
  requestAnimationFrame(turn);
}

/** Sets the places of the nodes to those at rest plus Re((a + i b) exp(i phase)). */
function displace(rest, places, parts) {
  const size = Number(element("amplitude").value) / 127;
  const c = size * Math.cos(view.phase), s = size * Math.sin(view.phase);
  for (let i = 0, k = 0; i < rest.length; i += 3, k += 6)
    for (let d = 0; d < 3; ++d)
      places[i + d] = rest[i + d] + c * parts[k + d] - s * parts[k + 3 + d];
}

function move() {
  if (view.parts)
    displace(view.rest, view.places, view.parts);
  else
    view.places.set(view.rest);
  for (const {mesh} of view.bodies) mesh.geometry.attributes.position.needsUpdate = true;
  render();
}

/** The stored shape of a mode; undefined if there is none. */
function shapeOf(row) {
  return data.shapes.find((one) => one.mode === eigen.mode[row] && isPointOf(one.at, row));
}

/** Fills the view with the shape of the selected mode, or reports that it was not kept. */
async function showShape() {
  if (!view.bodies) return;
  const asked = ++view.asked, row = state.selected;
  const shape = shapeOf(row);
  const parts = shape ? new Int8Array(await bytes(shape.blob)) : null;
  const work = shape && shape.work ? new Float32Array(await bytes(shape.work)) : null;
  if (asked !== view.asked || !view.bodies) return;  // another mode has been chosen meanwhile
  Object.assign(view, {parts, work});
  element("canvas").dataset.mode = shape ? shape.blob : "";
  if (!shape) element("chosen").textContent += " · its shape was not kept (-flutter_shapes)";
  view.held = true;  // one picture instead of three
  listFields();
  colour();
  showBodies();
  view.held = false;
  move();
}
