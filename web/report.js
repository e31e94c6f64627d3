"use strict";
// The report of a run: diagrams by Chart.js, shapes by three.js. One mode is selected at a time, in
// the diagrams, the table and the view.

const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const eigen = data.eigenvalues;
const rows = eigen.mode.map((_, i) => i);
const digits = (value, n = 6) =>
    (value === null || value === undefined ? "" : Number(Number(value).toPrecision(n)).toString());
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// What else is swept is chosen by a line of buttons; the diagrams show one line of the sweep at a
// time.
const across =
    data.swept.includes("friction") || data.swept.length === 0 ? "friction" : data.swept[0];
const others = data.parameters.filter((name) => name !== across);
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

function nameOfPoint(table, i) {
  return data.parameters.filter((name) => name === across || data.swept.includes(name))
      .map((name) => `${name} ${digits(table[name][i])}`)
      .join(", ");
}

function wordsOf(i) {
  const e = eigen;
  return [
    `mode ${e.mode[i]} at ${nameOfPoint(e, i)}`,
    `${digits(e.frequency_hz[i], 8)} Hz`,
    `growth ${digits(e.growth_rate_1_per_s[i], 6)} 1/s`,
    `damping ${
        e.damping_ratio[i] === null ? "unknown" : `${digits(100 * e.damping_ratio[i], 4)} %`}`,
    `error |δs|/|s| ${
        e.error_estimate && e.error_estimate[i] !== null ? e.error_estimate[i].toExponential(1) :
                                                           "unknown"}`,
    e.verdict[i],
  ].join("\n");
}

// ---- diagrams ----

const charts = {};
const inLine = () => rows.filter((i) => lineOf(eigen, i) === state.line);

/** The branches of the line, each with one active set, as lists of points. */
function branchLines(x, y) {
  const b = data.branches, found = new Map();
  if (!b || across !== "friction") return [];
  for (let i = 0; i < b.branch.length; ++i) {
    if (lineOf(b, i) !== state.line || b.in_band[i] === 0) continue;
    const key = `${b.active_set[i]} ${b.branch[i]}`;
    if (!found.has(key)) found.set(key, []);
    found.get(key).push({x: x(b, i), y: y(b, i), order: b.friction[i]});
  }
  const all = [];
  for (const points of found.values()) {
    points.sort((p, q) => p.order - q.order);
    all.push(...points, {x: NaN, y: NaN});
  }
  return all;
}

/** Shades every other interval of friction with one active set. */
const shading = {
  id: "shading",
  beforeDraw(chart) {
    const b = data.branches;
    if (!b || across !== "friction" || !chart.options.shaded) return;
    const ends = new Map();
    for (let i = 0; i < b.branch.length; ++i) {
      if (lineOf(b, i) !== state.line || b.active_set[i] === 0) continue;
      const [low, high] = ends.get(b.active_set[i]) || [Infinity, -Infinity];
      ends.set(b.active_set[i], [Math.min(low, b.friction[i]), Math.max(high, b.friction[i])]);
    }
    const area = chart.chartArea, context = chart.ctx, scale = chart.scales.x;
    context.fillStyle = css("--shade");
    [...ends.values()].sort((p, q) => p[0] - q[0]).forEach(([low, high], k) => {
      if (k % 2)
        context.fillRect(
            scale.getPixelForValue(low), area.top,
            scale.getPixelForValue(high) - scale.getPixelForValue(low), area.bottom - area.top);
    });
  },
};

/** The error of a critical friction in words. */
function errorOf(critical, i) {
  const error = critical.friction_error_estimate ? critical.friction_error_estimate[i] : null;
  const words = error === null ? "?" : error.toExponential(1);
  return critical.converged && !critical.converged[i] ?
      `${words}, not solved for: between points of the sweep` :
      words;
}

function datasets(x, y) {
  const e = eigen, at = (list) => list.map((i) => ({x: x(e, i), y: y(e, i), row: i}));
  const chosen = inLine(), grows = chosen.filter((i) => e.grows[i]),
        open = chosen.filter((i) => e.verdict[i] === "undecided");
  const calm = chosen.filter((i) => !e.grows[i] && e.verdict[i] !== "undecided");
  const most = Math.max(...rows.map((i) => (e.grows[i] ? e.growth_rate_1_per_s[i] : 0)), 1e-300);
  const colour = (i) => data.colours[Math.min(
      31, Math.max(0, Math.round(31 * (1 - e.growth_rate_1_per_s[i] / most))))];
  const sets = [
    {
      label: "branches",
      data: branchLines(x, y),
      showLine: true,
      pointRadius: 0,
      pointHitRadius: 0,
      borderColor: css("--line"),
      borderWidth: 1,
      order: 5
    },
    {
      label: "stable",
      data: at(calm),
      pointRadius: 2,
      pointHitRadius: 4,
      backgroundColor: css("--soft"),
      borderWidth: 0,
      order: 4
    },
    {
      label: "undecided",
      data: at(open),
      pointRadius: 4,
      backgroundColor: "#0000",
      borderColor: css("--ink"),
      order: 3
    },
    {
      label: "unstable",
      data: at(grows),
      pointRadius: 5,
      pointHitRadius: 6,
      borderWidth: 0.5,
      borderColor: css("--ink"),
      backgroundColor: grows.map((i) => `rgb(${colour(i).join(",")})`),
      order: 2
    },
    {
      label: "selected",
      data: state.selected >= 0 ?
          at([state.selected]).filter((p) => lineOf(e, p.row) === state.line) :
          [],
      pointRadius: 9,
      pointHitRadius: 0,
      backgroundColor: "#0000",
      borderColor: css("--accent"),
      borderWidth: 2.5,
      order: 0
    },
  ];
  const c = data.critical;
  if (c && across === "friction") {
    const points =
        c.friction.map((_, i) => i)
            .filter((i) => lineOf(c, i) === state.line)
            .map((i) => ({
                   x: x(c, i),
                   y: y(c, i),
                   text: `stability ${c.direction[i] === "loss" ? "is lost" : "is regained"} (${
                             c.kind[i]})\n` +
                       `friction ${digits(c.friction[i], 10)} ± ${errorOf(c, i)}\n${
                             digits(c.frequency_hz[i], 8)} Hz`
                 }))
            .filter((p) => Number.isFinite(p.y));
    sets.push({
      label: "critical frictions",
      data: points,
      pointStyle: "crossRot",
      pointRadius: 6,
      borderColor: css("--ink"),
      borderWidth: 1.5,
      order: 1
    });
  }
  return sets;
}

function hover(context) {
  const box = element("hover"), tip = context.tooltip;
  const point = tip.opacity && tip.dataPoints ?
      tip.dataPoints.map((p) => p.raw).find((p) => p.row !== undefined || p.text) :
      null;
  box.hidden = !point;
  if (!point) return;
  box.textContent = point.text || wordsOf(point.row);
  const frame = context.chart.canvas.getBoundingClientRect();
  box.style.left = `${Math.min(frame.left + tip.caretX + 12, innerWidth - 260)}px`;
  box.style.top = `${Math.min(frame.top + tip.caretY + 12, innerHeight - 130)}px`;
}

function chart(id, x, y, xTitle, yTitle, shaded) {
  charts[id] = {
    x,
    y,
    chart: new Chart(element(id), {
      type: "scatter",
      data: {datasets: datasets(x, y)},
      plugins: [shading],
      options: {
        shaded,
        animation: false,
        maintainAspectRatio: false,
        normalized: true,
        interaction: {mode: "nearest", intersect: true},
        onClick: (event, hits) => {
          const hit = hits.map((h) => charts[id].chart.data.datasets[h.datasetIndex].data[h.index])
                          .find((p) => p.row !== undefined);
          if (hit) select(hit.row);
        },
        plugins: {legend: {display: false}, tooltip: {enabled: false, external: hover}},
        scales: {
          x: {title: {display: true, text: xTitle}},
          y: {
            title: {display: true, text: yTitle},
            afterFit: (axis) => {
              axis.width = 72;
            }
          },  // so that the diagrams stand below each other
        },
      },
    })
  };
}

function drawCharts() {
  Chart.defaults.color = css("--ink");
  Chart.defaults.borderColor = css("--line");
  for (const one of Object.values(charts)) {
    for (const axis of Object.values(one.chart.options.scales)) {
      axis.grid = {color: css("--line")};
      axis.ticks = {...axis.ticks, color: css("--ink")};
      axis.title.color = css("--ink");
    }
    one.chart.data.datasets = datasets(one.x, one.y);
    one.chart.update("none");
  }
}

const names = {
  friction: "friction coefficient",
  speed: "speed factor",
  pressure: "pressure factor",
  damping: "damping factor"
};
const abscissa = (table, i) => table[across][i];
const hertz = (table, i) => (table.frequency_hz ? table.frequency_hz[i] : NaN);
const growth = (table, i) => (table.growth_rate_1_per_s ? table.growth_rate_1_per_s[i] : 0);

function makeCharts() {
  chart("frequency", abscissa, hertz, names[across], "frequency [Hz]", true);
  chart("growth", abscissa, growth, names[across], "growth rate [1/s]", true);
  chart("roots", growth, hertz, "growth rate [1/s]", "frequency [Hz]", false);
  for (const one of Object.values(charts))
    one.chart.canvas.addEventListener("mouseleave", () => {
      element("hover").hidden = true;
    });
  for (const id of ["sweep", "locus"]) element(id).addEventListener("keydown", walk);
  for (const button of document.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => show(button.dataset.view));
  drawCharts();
}

function show(view) {
  state.view = view;
  for (const button of document.querySelectorAll("[data-view]"))
    button.setAttribute("aria-pressed", String(button.dataset.view === view));
  element("sweep").hidden = view !== "sweep";
  element("locus").hidden = view !== "locus";
  for (const one of Object.values(charts)) one.chart.resize();
}

/**
 * Arrow keys: up and down among the modes of a point, which ascend in frequency; left and right to
 * the nearest eigenvalue of the next point.
 */
function walk(event) {
  const step = {ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowRight: [1, 0], ArrowLeft: [
                  -1, 0
                ]}[event.key];
  if (!step || state.selected < 0) return;
  event.preventDefault();
  const list = inLine(), here = state.selected, place = eigen[across][here];
  if (step[1]) {
    const same = list.filter((i) => eigen[across][i] === place)
                     .sort((a, b) => eigen.mode[a] - eigen.mode[b]);
    const next = same[same.indexOf(here) + step[1]];
    if (next !== undefined) select(next);
    return;
  }
  const values = [...new Set(list.map((i) => eigen[across][i]))].sort((a, b) => a - b),
        next = values[values.indexOf(place) + step[0]];
  if (next === undefined) return;
  const there = list.filter((i) => eigen[across][i] === next);
  const far = (i) => Math.hypot(...["angular_frequency_rad_per_s", "growth_rate_1_per_s"].map(
      (name) => eigen[name][i] - eigen[name][here]));
  select(there.reduce((a, b) => (far(b) < far(a) ? b : a)));
}

// ---- selection ----

function select(row) {
  state.selected = row;
  element("chosen").textContent = wordsOf(row).replaceAll("\n", " · ");
  if (lineOf(eigen, row) !== state.line) chooseLine(lineOf(eigen, row));
  drawCharts();
  markRow();
  showShape();
}

function chooseLine(line) {
  state.line = line;
  for (const button of element("line").querySelectorAll("button"))
    button.setAttribute("aria-pressed", String(button.dataset.line === line));
  drawCharts();
}

function makeLines() {
  if (lines.length < 2) return;
  element("line").hidden = false;
  for (const line of lines) {
    const button = document.createElement("button"), values = line.split(",");
    button.type = "button";
    button.dataset.line = line;
    button.textContent = others.map((name, k) => [name, values[k]])
                             .filter(([name]) => data.swept.includes(name))
                             .map((pair) => pair.join(" "))
                             .join(", ");
    button.addEventListener("click", () => {
      chooseLine(line);
      const list = inLine();
      select(list.reduce(
          (a, b) => (eigen.growth_rate_1_per_s[b] > eigen.growth_rate_1_per_s[a] ? b : a)));
    });
    element("line").append(button, " ");
  }
  chooseLine(state.line);
}

// ---- the table ----

const columns = [
  ...data.parameters.filter((name) => name === across || data.swept.includes(name))
      .map((name) => [name, name, (v) => digits(v)]),
  ["mode", "mode", String],
  ["frequency_hz", "frequency Hz", (v) => digits(v, 8)],
  ["growth_rate_1_per_s", "growth 1/s", (v) => digits(v, 6)],
  ["damping_ratio", "damping %", (v) => (v === null ? "" : digits(100 * v, 4))],
  ["error_estimate", "error |δs|/|s|", (v) => (v === null ? "" : v.toExponential(1))],
  ["verdict", "verdict", String],
].filter(([name]) => eigen[name]);
const mostRows = 2000;
let listed = [];

function listRows() {
  const words = state.find.trim().toLowerCase().split(/\s+/).filter(Boolean);
  listed = rows.filter(
      (i) => (!state.filter || eigen.grows[i] || eigen.verdict[i] === "undecided") &&
          words.every(
              (word) => columns.some(
                  ([name, , text]) => text(eigen[name][i]).toLowerCase().startsWith(word))));
  const key = eigen[state.sort], sign = state.down ? -1 : 1;
  listed.sort((a, b) => sign * (key[a] < key[b] ? -1 : key[a] > key[b] ? 1 : 0) || a - b);
  const table = element("table"), head = document.createElement("thead"),
        body = document.createElement("tbody"), top = head.insertRow();
  for (const [name, title] of columns) {
    const cell = document.createElement("th"), button = document.createElement("button");
    button.type = "button";
    button.textContent = title + (state.sort === name ? (state.down ? " ▼" : " ▲") : "");
    button.addEventListener("click", () => {
      state.down = state.sort === name ? !state.down : true;
      state.sort = name;
      listRows();
    });
    cell.setAttribute(
        "aria-sort", state.sort === name ? (state.down ? "descending" : "ascending") : "none");
    if (name === "verdict") cell.className = "word";
    cell.append(button);
    top.append(cell);
  }
  for (const i of listed.slice(0, mostRows)) {
    const row = body.insertRow();
    row.dataset.row = i;
    row.tabIndex = 0;
    for (const [name, , text] of columns) {
      const cell = row.insertCell();
      cell.textContent = text(eigen[name][i]);
      if (name === "verdict") cell.className = "word";
    }
  }
  table.replaceChildren(head, body);
  element("count").textContent = `${listed.length} of ${rows.length} eigenvalues` +
      (listed.length > mostRows ? `, the first ${mostRows} shown` : "");
  markRow();
}

function markRow() {
  for (const row of element("table").querySelectorAll("tbody tr"))
    row.classList.toggle("selected", Number(row.dataset.row) === state.selected);
}

function makeTable() {
  const open = (event) => {
    const row = event.target.closest("tbody tr");
    if (row) select(Number(row.dataset.row));
  };
  element("table").addEventListener("click", open);
  element("table").addEventListener("keydown", (event) => {
    if (event.key === "Enter" && event.target.matches("tr")) open(event);
  });
  element("filter").addEventListener("change", (event) => {
    state.filter = event.target.value;
    listRows();
  });
  element("find").addEventListener("input", (event) => {
    state.find = event.target.value;
    listRows();
  });
  element("download").addEventListener("click", () => {
    const keys = Object.keys(eigen).filter((name) => name !== "grows");
    const text =
        [
          keys.join(","), ...listed.map((i) => keys.map((name) => eigen[name][i] ?? "").join(","))
        ].join("\n") +
        "\n";
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], {type: "text/csv"}));
    link.download = "eigenvalues.csv";
    link.click();
    URL.revokeObjectURL(link.href);
  });
  if (!rows.some((i) => eigen.grows[i] || eigen.verdict[i] === "undecided"))
    element("filter").value = state.filter = "";
  listRows();
}

// ---- the shape ----

/** The bytes that stand in the file under a name. */
async function bytes(name) {
  const packed = Uint8Array.from(atob(element(`blob-${name}`).textContent), (c) => c.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate")))
      .arrayBuffer();
}

const view = {
  phase: 0,
  playing: !matchMedia("(prefers-reduced-motion: reduce)").matches,
  bodies: null,
  parts: null,
  asked: 0
};

/**
 * Why this browser cannot draw shapes; null where it can. three.js would end the script, and with
 * it tables and diagrams.
 */
function whyNoShapes() {
  const probe = document.createElement("canvas");
  if (!probe.getContext("webgl2") && !probe.getContext("webgl"))
    return "this browser offers no WebGL: it is turned off, or has no driver here";
  return typeof DecompressionStream === "undefined" ?
      "this browser is too old to unpack them (it has no DecompressionStream)" :
      null;
}

/** Says why no shape is drawn, in the place of the view. */
function withoutView(why) {
  const note = document.createElement("p");
  note.id = "noview";
  note.className = "note";
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
  const rest = Float32Array.from(new Int16Array(await bytes("places")), (v) => v / 65534);
  const triangles = new Uint32Array(await bytes("triangles")),
        edges = new Uint32Array(await bytes("lines"));
  const steady = new Float32Array(await bytes("steady"));
  Object.assign(view, {
    rest,
    touching: new Uint32Array(await bytes("touching")),
    places: rest.slice(),
    colours: new Float32Array(rest.length),
    steady
  });
  view.renderer = new THREE.WebGLRenderer(
      {canvas: element("canvas"), antialias: true, preserveDrawingBuffer: true});
  element("canvas").addEventListener("webglcontextlost", () => {
    play(false);
    withoutView("the browser has taken WebGL away from this page; load it again");
  });
  view.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
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
  view.bodies = skin.bodies.map((body) => {
    const [first, last] = body.nodes,
                  part = (all) => new THREE.BufferAttribute(all.subarray(3 * first, 3 * last), 3);
    const geometry = new THREE.BufferGeometry(), still = new THREE.BufferGeometry();
    geometry.setAttribute("position", part(view.places));
    geometry.setAttribute("color", part(view.colours));
    geometry.setIndex(new THREE.BufferAttribute(
        triangles.subarray(3 * body.triangles[0], 3 * body.triangles[1]).map((i) => i - first), 1));
    still.setAttribute("position", part(view.rest));
    still.setIndex(new THREE.BufferAttribute(
        edges.subarray(2 * body.lines[0], 2 * body.lines[1]).map((i) => i - first), 1));
    const mesh = new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({
      vertexColors: THREE.VertexColors,
      flatShading: true,
      side: THREE.DoubleSide,
      shininess: 8
    }));
    const outline = new THREE.LineSegments(
        still, new THREE.LineBasicMaterial({transparent: true, opacity: 0.45}));
    mesh.frustumCulled = outline.frustumCulled = false;
    view.scene.add(mesh, outline);
    return {mesh, outline};
  });
  skin.bodies.forEach((body, k) => {
    const label = document.createElement("label"), box = document.createElement("input");
    box.type = "checkbox";
    box.checked = true;
    box.addEventListener("change", () => {
      view.bodies[k].mesh.visible = box.checked;
      outlines();
    });
    label.append(box, ` ${body.name}`);
    element("bodies").append(label, " ");
  });
  const point = element("point");
  point.max = Math.max(0, skin.steady.length - 1);
  point.addEventListener("input", colour);
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
  play(view.playing);
  fit();
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
  view.scene.background = new THREE.Color(css("--paper"));
  view.renderer.render(view.scene, view.camera);
}

function outlines() {
  view.bodies.forEach(({mesh, outline}) => {
    outline.visible = mesh.visible && element("outline").checked;
    outline.material.color.set(css("--soft"));
  });
  render();
}

function play(playing) {
  view.playing = playing;
  element("play").textContent = playing ? "Pause" : "Play";
  element("play").setAttribute("aria-pressed", String(playing));
  if (playing) requestAnimationFrame(turn);
}

let last = 0;
function turn(time) {
  if (!view.playing) return;
  view.phase = (view.phase + Math.min(0.1, (time - last) / 1000) * Math.PI) %
      (2 * Math.PI);  // half a turn a second
  last = time;
  element("phase").value = Math.round((view.phase * 180) / Math.PI);
  move();
  requestAnimationFrame(turn);
}

/** Moves the nodes to Re((a + i b) exp(i phase)). */
function move() {
  const {rest, places, parts} = view, size = Number(element("amplitude").value) / 127;
  const c = size * Math.cos(view.phase), s = size * Math.sin(view.phase);
  if (!parts)
    places.set(rest);
  else
    for (let i = 0, k = 0; i < rest.length; i += 3, k += 6)
      for (let d = 0; d < 3; ++d)
        places[i + d] = rest[i + d] + c * parts[k + d] - s * parts[k + 3 + d];
  for (const {mesh} of view.bodies) mesh.geometry.attributes.position.needsUpdate = true;
  render();
}

const fields = {
  amplitude: ["amplitude", "relative"],
  work: ["friction work of the mode", "1/(s m²)"],
  pressure: ["contact pressure", "Pa"],
  gap: ["gap", "m"],
};

/**
 * The values of the chosen field by contact node or, for the amplitude, by node; null where there
 * are none.
 */
function fieldValues(name) {
  const skin = data.skin, n = view.touching.length;
  if (name === "amplitude") {
    if (!view.parts) return null;
    const values = new Float32Array(view.rest.length / 3);
    for (let i = 0; i < values.length; ++i) {
      let sum = 0;
      for (let d = 0; d < 6; ++d) sum += view.parts[6 * i + d] ** 2;
      values[i] = Math.sqrt(sum);
    }
    const most = values.reduce((a, b) => Math.max(a, b), 0) || 1;
    return values.map((value) => value / most);
  }
  if (name === "work") return view.work;
  if (!skin.steady.length) return null;
  const first = (2 * Number(element("point").value) + (name === "gap" ? 1 : 0)) * n;
  return view.steady.subarray(first, first + n);
}

function colour() {
  const name = element("field").value, values = fieldValues(name), onContact = name !== "amplitude";
  const steadyField = name === "pressure" || name === "gap";
  element("at").hidden = !steadyField;
  if (steadyField) {
    const at = data.skin.steady[Number(element("point").value)];
    element("pointname").textContent = data.parameters.map((p, k) => [p, at[k]])
                                           .filter(([p]) => p === across || data.swept.includes(p))
                                           .map(([p, v]) => `${p} ${digits(v)}`)
                                           .join(", ");
  }
  const grey = [0.62, 0.65, 0.68];
  for (let i = 0; i < view.colours.length; i += 3) view.colours.set(grey, i);
  element("scale").hidden = !values;
  if (values) {
    let low = Math.min(0, values.reduce((a, b) => Math.min(a, b), Infinity)),
        high = values.reduce((a, b) => Math.max(a, b), -Infinity);
    if (name === "work") {
      high = Math.max(high, -low);
      low = -high;
    }  // the middle of the scale is zero
    if (!(high > low)) high = low + 1;
    const pick = (value) =>
        data.colours[Math.min(31, Math.max(0, Math.floor((32 * (value - low)) / (high - low))))];
    values.forEach(
        (value, k) => view.colours.set(
            pick(value).map((c) => c / 255), 3 * (onContact ? view.touching[k] : k)));
    const [title, unit] = fields[name], bar = document.createElement("i");
    bar.style.background =
        `linear-gradient(to top, ${data.colours.map((c) => `rgb(${c.join(",")})`).join(",")})`;
    element("scale").replaceChildren(
        `${title} [${unit}]`, document.createElement("br"), digits(high, 3), bar, digits(low, 3));
  }
  for (const {mesh} of view.bodies) mesh.geometry.attributes.color.needsUpdate = true;
  render();
}

/** Fills the view with the shape of the selected mode, or says why there is none. */
async function showShape() {
  if (!view.bodies) return;
  const asked = ++view.asked, row = state.selected;
  const shape = data.shapes.find(
      (one) => one.mode === eigen.mode[row] &&
          data.parameters.every((name, k) => one.at[k] === eigen[name][row]));
  const parts = shape ? new Int8Array(await bytes(shape.blob)) : null,
        work = shape && shape.work ? new Float32Array(await bytes(shape.work)) : null;
  if (asked !== view.asked || !view.bodies) return;  // another mode has been chosen meanwhile
  Object.assign(view, {parts, work});
  element("canvas").dataset.mode = shape ? shape.blob : "";
  if (!shape) element("chosen").textContent += " · its shape was not kept (-flutter_shapes)";
  const chosen = element("field").value;
  element("field").replaceChildren(
      ...Object.entries(fields)
          .filter(([name]) => fieldValues(name) && fieldValues(name).length)
          .map(([name, [title]]) => new Option(title, name)));
  if ([...element("field").options].some((option) => option.value === chosen))
    element("field").value = chosen;
  colour();
  outlines();
  move();
}

// ---- what else there is ----

function tableOf(head, body, words = 1) {
  const table = document.createElement("table"), top = table.createTHead().insertRow();
  head.forEach((title, k) => {
    const cell = document.createElement("th");
    cell.textContent = title;
    if (k < words) cell.className = "word";
    top.append(cell);
  });
  const rest = table.createTBody();
  for (const line of body) {
    const row = rest.insertRow();
    line.forEach((value, k) => {
      const cell = row.insertCell();
      if (k < words) cell.className = "word";
      if (value instanceof Node)
        cell.append(value);
      else
        cell.textContent = typeof value === "number" ? digits(value) : value;
    });
  }
  return table;
}

function section(title, ...content) {
  const box = document.createElement("details"), head = document.createElement("summary"),
        frame = document.createElement("div");
  head.textContent = title;
  frame.className = "scroll";
  frame.append(...content);
  box.append(head, frame);
  element("more").append(box);
}

function bar(value, most) {
  const mark = document.createElement("span");
  mark.className = "bar";
  mark.style.width = `${(10 * Math.abs(value)) / most}rem`;
  mark.style.opacity = value < 0 ? 0.4 : 1;
  return mark;
}

/** A table with bars of the last column, the largest first. */
function bars(title, table, keys, value, heads) {
  if (!table || !table[value] || !table[value].length) return;
  const order = table[value]
                    .map((_, i) => i)
                    .filter((i) => table[value][i] !== null)
                    .sort((a, b) => Math.abs(table[value][b]) - Math.abs(table[value][a]))
                    .slice(0, 200);
  if (!order.length) return;
  const most = Math.abs(table[value][order[0]]) || 1;
  section(
      title,
      tableOf(
          [...heads, ""],
          order.map(
              (i) =>
                  [...keys.map((key) => (key === "point" ? nameOfPoint(table, i) : table[key][i])),
                   table[value][i], bar(table[value][i], most)]),
          1));
}

/**
 * For each value of what else is swept, a table over the abscissa and one more parameter; stable
 * points stand on the plain ground.
 */
function maps() {
  const p = data.points, count = (name) => new Set(p[name]).size;
  const columnsOf =
      data.swept.filter((name) => name !== across).reduce((a, b) => (count(b) > count(a) ? b : a));
  const rest = data.swept.filter((name) => name !== across && name !== columnsOf),
        all = p.friction.map((_, i) => i);
  const most = Math.max(
      ...all.map((i) => (p.unstable_modes[i] > 0 ? p.largest_growth_rate_1_per_s[i] : 0)), 1e-300);
  const keyOf = (i) => rest.map((name) => `${name} ${digits(p[name][i])}`).join(", ");
  return [...new Set(all.map(keyOf))].map((key) => {
    const mine = all.filter((i) => keyOf(i) === key),
          ascending = (name) => [...new Set(mine.map((i) => p[name][i]))].sort((a, b) => a - b);
    const head = ascending(columnsOf), body = ascending(across).reverse();
    const table = tableOf(
        [`${across} \\ ${columnsOf}${key ? `, at ${key}` : ""}`, ...head.map((v) => digits(v))],
        body.map((y) => [`${digits(y)}`, ...head.map((x) => {
                   const i = mine.find((k) => p[columnsOf][k] === x && p[across][k] === y),
                         mark = document.createElement("span");
                   if (i === undefined || p.unstable_modes[i] === null)
                     mark.textContent = "no steady sliding";
                   else if (p.unstable_modes[i] === 0)
                     mark.textContent = p.verdict[i];
                   else {
                     const value = p.largest_growth_rate_1_per_s[i],
                           place = Math.round(31 * (1 - Math.max(0, value) / most));
                     mark.textContent = `${digits(value, 4)} (${p.unstable_modes[i]})`;
                     mark.style.cssText =
                         `background: rgb(${data.colours[place].join(",")}); color: ${
                             place > 15 ? "#000" : "#fff"}; padding: 0 0.4rem;`;
                   }
                   return mark;
                 })]));
    return table;
  });
}

function makeRest() {
  const p = data.points;
  section(
      "Points of the sweep",
      tableOf(
          ["point", "unstable modes", "largest growth 1/s", "at Hz", "verdict"],
          p.friction.map(
              (_, i) =>
                  [nameOfPoint(p, i), p.unstable_modes[i], p.largest_growth_rate_1_per_s[i],
                   p.frequency_hz[i], p.verdict[i]])));
  if (data.swept.length > 1)
    section("Stability maps: largest growth rate [1/s] and number of unstable modes", ...maps());
  if (data.critical && data.critical.friction.length) {
    const c = data.critical;
    section(
        "Critical frictions",
        tableOf(
            ["stability", "friction", "frequency Hz", "kind", "estimated error of the friction"],
            c.friction.map(
                (_, i) =>
                    [c.direction[i] === "loss" ? "lost" : "regained", digits(c.friction[i], 10),
                     digits(c.frequency_hz[i], 8), c.kind[i], errorOf(c, i)])));
  }
  bars(
      "Which interface feeds a mode: growth by its friction", data.frictionWork,
      ["point", "mode", "frequency_hz", "interface"], "friction_work_1_per_s",
      ["point", "mode", "frequency Hz", "interface", "growth 1/s"]);
  bars(
      "Sensitivities: derivatives of the growth rate", data.sensitivities,
      ["point", "mode", "frequency_hz", "parameter"], "growth_rate_derivative_1_per_s",
      ["point", "mode", "frequency Hz", "parameter", "1/s per unit"]);
  if (data.steady.length)
    section(
        "Steady sliding: forces of the interfaces",
        tableOf(
            ["interface", "point", "normal N", "friction N", "open nodes"],
            data.steady.map(
                (row) =>
                    [row[4],
                     data.parameters.map((name, k) => [name, row[k]])
                         .filter(([name]) => name === across || data.swept.includes(name))
                         .map((pair) => pair.join(" "))
                         .join(", "),
                     row[5], row[6], row[7]]),
            2));
  section(
      "Time, memory and size",
      tableOf(
          ["stage", "time s", "largest memory so far, MB"],
          [
            ...Object.entries(data.stages).map(([name,
                                                 [time, memory]]) => [name, time, memory / 1e6]),
            ["all", data.wallSeconds, ""]
          ]),
      tableOf(
          ["size", ""],
          Object.entries(data.sizes).map(([name, value]) => [name.replace("_", " "), value])));
  for (const text of data.left) {
    const line = document.createElement("p");
    line.className = "note";
    line.textContent = text;
    element("more").append(line);
  }
  element("recipe").append(tableOf(
      ["option", `value (squeal ${data.version})`],
      Object.entries(data.options).map(([name, value]) => [`-${name}`, value]), 2));
}

function setScheme(dark) {
  document.documentElement.classList.toggle("dark", dark);
  element("scheme").textContent = dark ? "Light" : "Dark";
  drawCharts();
  drawRegime();
  if (view.bodies) outlines();
}

async function begin() {
  element("main").hidden = false;
  makeCharts();
  makeLines();
  makeTable();
  makeRegime();
  makeRest();
  element("scheme").addEventListener(
      "click", () => setScheme(!document.documentElement.classList.contains("dark")));
  setScheme(matchMedia("(prefers-color-scheme: dark)").matches);
  await makeView();
  const kept = data.shapes.length ?
      rows.find(
          (i) => eigen.mode[i] === data.shapes[0].mode &&
              data.parameters.every((name, k) => data.shapes[0].at[k] === eigen[name][i])) :
      undefined;
  if (rows.length)
    select(
        kept ??
        rows.reduce(
            (a, b) => (eigen.growth_rate_1_per_s[b] > eigen.growth_rate_1_per_s[a] ? b : a)));
  document.documentElement.dataset.ready = "yes";
}

begin();
