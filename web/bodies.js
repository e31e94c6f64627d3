// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The bodies in the view of a mode: shown, transparent or hidden, and pulled apart.

const bodyStates = ["shown", "transparent", "hidden"];
const bodyMarks = {
  shown: "●",
  transparent: "◐",
  hidden: "○"
};
const mostEnergy = 0.8;  // the share of the bodies that are shown at first

/** Gives a body one of the three states. */
function setBody(k, value) {
  const {mesh} = view.bodies[k], button = element("bodies").children[k],
        {name} = data.skin.bodies[k];
  view.bodies[k].state = value;
  mesh.visible = value !== "hidden";
  mesh.material.transparent = value === "transparent";
  mesh.material.opacity = value === "transparent" ? 0.16 : 1;
  mesh.material.depthWrite = value !== "transparent";
  mesh.material.needsUpdate = true;
  button.textContent = `${bodyMarks[value]} ${name}`;
  button.setAttribute("aria-label", `${name}: ${value}`);
  button.dataset.state = value;
}

/** Makes the button that changes the state of a body. */
function makeBodyButton(body, k) {
  const button = make("button", {type: "button", className: "body"});
  button.title = "shown, transparent or hidden";
  button.addEventListener("click", () => {
    const place = bodyStates.indexOf(view.bodies[k].state);
    setBody(k, bodyStates[(place + 1) % bodyStates.length]);
    element("show").value = "chosen";
    outlines();
  });
  element("bodies").append(button);
}

/** The kinetic energy of each body in the selected mode, and where it is from; null without. */
function energiesOfBodies() {
  const c = data.components, list = componentRows.get(modeKey(eigen, state.selected)) || [];
  const share = (name) => sum(list.filter((k) => c.kind[k] === "body" && c.component[k] === name)
                                  .map((k) => c.kinetic_share[k]));
  if (list.length)
    return {values: data.skin.bodies.map(({name}) => share(name)), words: "kinetic energy"};
  if (!view.parts) return null;
  const squares = amplitudes(view.parts).map((value) => value ** 2);
  const estimate = ({nodes: [first, last], volume}) =>
      (volume * sum(Array.from(squares.subarray(first, last)))) / (last - first);
  return {
    values: data.skin.bodies.map(estimate),
    words: "kinetic energy, estimated from the surface"
  };
}

/** Shows the bodies that have most of the energy, and makes the others transparent. */
function showEnergetic() {
  const energy = energiesOfBodies();
  element("energetic").textContent = "";
  if (!energy) {
    view.bodies.forEach((_, k) => setBody(k, "shown"));
    return;
  }
  const {values, words} = energy, total = sum(values) || 1;
  const order = values.map((_, k) => k).sort((a, b) => values[b] - values[a]);
  let reached = 0;
  const first = [];
  for (const k of order) {
    setBody(k, reached < mostEnergy * total ? "shown" : "transparent");
    if (reached < mostEnergy * total) first.push(k);
    reached += values[k];
  }
  const text =
      first.map((k) => `${data.skin.bodies[k].name} ${Math.round((100 * values[k]) / total)} %`);
  element("energetic").textContent = `Most ${words}: ${text.join(", ")}`;
}

/** Gives all bodies their states by the menu. */
function showBodies() {
  const menu = element("show").value;
  if (menu === "energy") showEnergetic();
  if (menu === "all") view.bodies.forEach((_, k) => setBody(k, "shown"));
  element("energetic").hidden = menu !== "energy";
  outlines();
}

/** The zoom at which all bodies are in the view, pulled apart by a share of the largest way. */
function zoomApart(share) {
  view.camera.zoom = 1;
  view.camera.updateProjectionMatrix();
  let most = 0;
  data.skin.bodies.forEach(({apart}, k) => {
    const {min, max} = view.bodies[k].box, ends = [min.toArray(), max.toArray()];
    for (let corner = 0; corner < 8; ++corner) {
      const place = apart.map((value, d) => ends[(corner >> d) & 1][d] + share * value);
      const {x, y} = new THREE.Vector3(...place).project(view.camera);
      most = Math.max(most, Math.abs(x), Math.abs(y));
    }
  });
  return Math.min(1, 0.95 / most);
}

/** Pulls the bodies apart, and moves the eye away so that all stay in the view. */
function explode() {
  const share = Number(element("explode").value);
  data.skin.bodies.forEach(({apart}, k) => {
    for (const part of [view.bodies[k].mesh, view.bodies[k].outline])
      part.position.set(...apart.map((value) => share * value));
  });
  view.camera.zoom = share > 0 ? zoomApart(share) : 1;
  view.camera.updateProjectionMatrix();
  render();
}

/** The view of the mode as it is, with its words and its scale. */
function canvasOfShape() {
  const from = element("canvas"),
        picture = make("canvas", {width: from.width, height: from.height});
  const context = picture.getContext("2d"), ratio = from.width / element("view").clientWidth;
  render();
  context.drawImage(from, 0, 0);
  context.scale(ratio, ratio);
  const width = from.width / ratio, words = element("chosen").textContent.split(" · ");
  writeText(context, words.slice(0, 3).join(" · "), 10, 16);
  const name = element("field").value;
  if (element("scale").hidden || !fields[name]) return picture;
  const [low, high] = rangeOf(name, fieldValues(name)), [title, unit] = fields[name];
  data.colours.forEach((one, k) => {
    context.fillStyle = rgb(one);
    context.fillRect(width - 26, 196 - 4.5 * k, 14, 4.8);
  });
  writeText(context, `${title} [${unit}]`, width - 12, 16, "right");
  writeText(context, digits(high, 3), width - 12, 42, "right");
  writeText(context, digits(low, 3), width - 12, 214, "right");
  return picture;
}

function makeBodies() {
  data.skin.bodies.forEach(makeBodyButton);
  view.bodies.forEach((body, k) => {
    body.mesh.geometry.computeBoundingBox();
    body.box = body.mesh.geometry.boundingBox.clone();
    setBody(k, "shown");
  });
  element("explode").parentElement.hidden =
      data.skin.bodies.every(({apart}) => apart.every((value) => value === 0));
  element("explode").addEventListener("input", explode);
  element("show").addEventListener("change", showBodies);
  element("view").append(
      saveButtons("shape", "the view of the mode", {png: () => pngOf(canvasOfShape())}));
}
