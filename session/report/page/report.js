// SPDX-License-Identifier: Apache-2.0
"use strict";
document.documentElement.classList.add("js");
const data = JSON.parse(document.getElementById("run-data").textContent);
const decode = (text, Type) => new Type(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
const byId = id => document.getElementById(id);
const inkOf = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
const clamp = (v, low, high) => Math.min(high, Math.max(low, v));

// ---- numbers --------------------------------------------------------------------------------------------------

/// Returns a number with three significant digits and a typographic minus sign.
function sensible(v) {
  if (!Number.isFinite(v)) return "–";
  const power = powerFor(Math.abs(v)), digits = v / 10 ** power;
  const decimals = v === 0 ? 0 : clamp(2 - Math.floor(Math.log10(Math.abs(digits))), 0, 4);
  return withMinus(digits.toFixed(decimals)) + (power ? "\u00a0·\u00a0" + powerOfTen(power) : "");
}
const withMinus = text => /^-[0.]*$/.test(text) ? text.slice(1) : text.replace("-", "\u2212");

/// Returns the power of ten, a multiple of 3, in which numbers up to `size` are short; 0 if they are short already.
function powerFor(size) { return size > 0 && (size < 1e-3 || size >= 1e6) ? 3 * Math.floor(Math.log10(size) / 3) : 0; }
const powerOfTen = power => "10" + [...String(power)].map(c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]).join("");
/// Returns the title of an axis: "thrust in N", or "thrust in 10⁻⁹ N" for numbers in that power of ten.
function axisTitle(name, unit, power) {
  const scaled = [power ? powerOfTen(power) : "", unit].filter(word => word).join(" ");
  return scaled ? name + " in " + scaled : name;
}

/// Returns about `count` round numbers from `low` to `high`, their texts, and the power of ten of the texts.
function roundTicks(low, high, count) {
  const raw = (high - low) / Math.max(1, count), power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(f => f * power).find(s => s >= raw * 0.999);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(i * step);
  const shortBy = powerFor(Math.max(Math.abs(low), Math.abs(high))), scale = 10 ** shortBy;
  const decimals = clamp(-Math.floor(Math.log10(step / scale) + 1e-9), 0, 6);
  return { ticks, texts: ticks.map(v => withMinus((v / scale).toFixed(decimals))), power: shortBy };
}

// ---- plots ----------------------------------------------------------------------------------------------------

const rows = data.rows, count = rows.count;
for (const name of ["time", "thrust", "torque", "sent", "lateral", "depth"]) rows[name] = decode(rows[name], Float32Array);
rows.tissue = decode(rows.tissue, Int8Array);
for (const signal of data.signals) signal.values = decode(signal.values, Float32Array);

const colourOf = tissue => tissue >= 0 && tissue < data.tissues.length ? data.tissues[tissue].colour : null;
const margin = { left: 58, right: 14, bottom: 22 };
const plots = [];
let cursor = -1;  // index of a row, the same for all plots

function rangeOf(values, from, to, accept) {
  let low = Infinity, high = -Infinity;
  for (let i = from; i < to; ++i) if (accept(i) && Number.isFinite(values[i])) { low = Math.min(low, values[i]); high = Math.max(high, values[i]); }
  return low <= high ? [low, high] : [0, 1];
}

class Axis {  // the common x axis of several plots
  constructor(low, high) { this.whole = [low, high > low ? high : low + 1]; this.reset(); }
  reset() { this.view = [...this.whole]; }
}

class Plot {
  constructor(id, axis, options) {
    Object.assign(this, { canvas: byId(id), axis, ...options });
    this.selection = null;
    this.top = this.namesEvents ? 42 : 24;  // the names of events are between title and plot
    plots.push(this);
    if (!this.isStrip) this.listen();
  }

  listen() {
    const at = e => clamp(e.clientX - this.canvas.getBoundingClientRect().left, margin.left, this.width - margin.right);
    this.canvas.addEventListener("pointerdown", e => { this.canvas.setPointerCapture(e.pointerId); this.selection = [at(e), at(e)]; });
    this.canvas.addEventListener("pointermove", e => {
      if (this.selection) this.selection[1] = at(e);
      cursor = this.nearest(at(e), e.clientY - this.canvas.getBoundingClientRect().top);
      later(drawAll);
    });
    const release = zooms => () => {
      const s = this.selection;
      this.selection = null;
      if (zooms && s && Math.abs(s[1] - s[0]) > 6) this.axis.view = s.map(px => this.xAt(px)).sort((a, b) => a - b);
      later(drawAll);
    };
    this.canvas.addEventListener("pointerup", release(true));
    this.canvas.addEventListener("pointercancel", release(false));
    this.canvas.addEventListener("pointerleave", () => { if (!this.selection) { cursor = -1; later(drawAll); } });
    this.canvas.addEventListener("dblclick", () => { this.axis.reset(); later(drawAll); });
  }

  px(x) { const [a, b] = this.axis.view; return margin.left + (x - a) / (b - a) * (this.width - margin.left - margin.right); }
  xAt(px) { const [a, b] = this.axis.view; return a + (px - margin.left) / (this.width - margin.left - margin.right) * (b - a); }
  py(y) { const [a, b] = this.yView; return this.height - margin.bottom - (y - a) / (b - a) * (this.height - this.top - margin.bottom); }

  nearest(px, py) {
    if (this.isTime) return indexAt(this.xAt(px));
    let best = -1, least = Infinity;
    const [from, to] = this.shown ? [this.shown.begin, this.shown.end] : [0, count];
    for (let i = from; i < to; ++i) {
      const d = (this.px(this.x[i]) - px) ** 2 + 0.05 * (this.py(this.y[i]) - py) ** 2;
      if (d < least) { least = d; best = i; }
    }
    return best;
  }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth; this.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.width * ratio); this.canvas.height = Math.round(this.height * ratio);
    const g = this.g = this.canvas.getContext("2d");
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    g.font = "12px system-ui, 'Noto Sans', 'DejaVu Sans', sans-serif";
    if (this.isStrip) { this.drawTissues(3, 12); return; }

    const [from, to] = this.isTime ? this.visible() : this.shown ? [this.shown.begin, this.shown.end] : [0, count];
    const [low, high] = rangeOf(this.y, from, to, i => this.x[i] >= this.axis.view[0] && this.x[i] <= this.axis.view[1]);
    const reach = high;
    const limits = (this.limits || []).filter(line => line.value <= 3 * Math.max(reach, 1e-9));
    const bottom = Math.min(0, low), top = Math.max(0, high, ...limits.map(line => line.value)), room = (top - bottom || 1) * 0.06;
    this.yView = [bottom - (bottom < 0 ? room : 0), top + (top > 0 ? room : 1)];

    this.drawFrame();
    if (this.isTime) this.drawEvents();
    g.save();
    g.beginPath(); g.rect(margin.left, this.top, this.width - margin.left - margin.right, this.height - this.top - margin.bottom); g.clip();
    if (this.shown) { this.drawBands(from, to); this.drawStrokes(); this.drawBounds(limits); }
    else this.drawLine(from, to);
    this.drawCursor();
    if (this.selection) {
      g.fillStyle = inkOf("wash");
      g.fillRect(Math.min(...this.selection), 0, Math.abs(this.selection[1] - this.selection[0]), this.height);
    }
    g.restore();
    if (this.isTime && this.namesEvents) this.drawMoments();
  }

  visible() { return [Math.max(0, indexAt(this.axis.view[0]) - 1), Math.min(count, indexAt(this.axis.view[1]) + 2)]; }

  drawFrame() {
    const g = this.g, right = this.width - margin.right, base = this.height - margin.bottom;
    g.lineWidth = 1; g.strokeStyle = inkOf("grid"); g.fillStyle = inkOf("soft");
    const y = roundTicks(...this.yView, (base - this.top) / 34);
    g.textAlign = "right"; g.textBaseline = "middle";
    for (const [i, v] of y.ticks.entries()) {
      const py = Math.round(this.py(v)) + 0.5;
      g.beginPath(); g.moveTo(margin.left, py); g.lineTo(right, py); g.stroke();
      g.fillText(y.texts[i], margin.left - 8, py);
    }
    const x = roundTicks(...this.axis.view, (right - margin.left) / 90), xTitle = axisTitle(this.xName, this.xUnit, x.power);
    g.textAlign = "center"; g.textBaseline = "top";
    for (const [i, v] of x.ticks.entries()) {
      const px = Math.round(this.px(v)) + 0.5;
      g.beginPath(); g.moveTo(px, this.top); g.lineTo(px, base); g.stroke();
      if (px < right - g.measureText(xTitle).width - 20) g.fillText(x.texts[i], px, base + 6);
    }
    g.textAlign = "right"; g.fillText(xTitle, right, base + 6);
    g.strokeStyle = inkOf("line");
    const zero = Math.round(this.py(0)) + 0.5;
    g.beginPath(); g.moveTo(margin.left, zero); g.lineTo(right, zero); g.stroke();
    g.fillStyle = inkOf("ink"); g.textAlign = "left"; g.textBaseline = "top";
    g.fillText(axisTitle(this.name, this.unit, y.power), margin.left, 4);
  }

  drawLine(from, to) {
    const g = this.g;
    g.strokeStyle = inkOf("accent"); g.lineWidth = 1.5; g.lineJoin = "round";
    g.beginPath();
    for (let i = from; i < to; ++i) g.lineTo(this.px(this.x[i]), this.py(this.y[i]));
    g.stroke();
  }

  /// Draws the strokes of one step along its axis: inwards over outwards.
  drawStrokes() {
    const g = this.g;
    g.lineJoin = "round";
    for (const isInward of [false, true]) {
      g.strokeStyle = inkOf(isInward ? "accent" : "accent-2"); g.lineWidth = isInward ? 1.7 : 1.1;
      for (const [begin, end, isIn] of this.shown.strokes) {
        if (isIn !== isInward) continue;
        g.beginPath();
        for (let i = begin; i <= end; ++i) g.lineTo(this.px(this.x[i]), this.py(this.y[i]));
        g.stroke();
      }
    }
  }

  /// Draws goals and limits as lines with their names.
  drawBounds(limits) {
    const g = this.g, right = this.width - margin.right, base = this.height - margin.bottom;
    g.setLineDash([5, 4]); g.lineWidth = 1.3; g.textBaseline = "bottom";
    for (const line of limits) {
      const py = this.py(line.value);
      g.strokeStyle = g.fillStyle = inkOf("bad"); g.textAlign = "left";
      g.beginPath(); g.moveTo(margin.left, py); g.lineTo(right, py); g.stroke();
      g.fillText(line.text, margin.left + 6, py - 2);
    }
    for (const line of this.shown.depths) {
      const px = this.px(line.value);
      g.strokeStyle = inkOf(line.isGoal ? "good" : "bad");
      g.beginPath(); g.moveTo(px, this.top); g.lineTo(px, base); g.stroke();
    }
    g.setLineDash([]);
  }

  /// Draws the numbers of deductions at their moments; crowded ones go down.
  drawMoments() {
    const g = this.g, taken = [];
    for (const moment of data.moments) {
      const exact = this.px(moment.time);
      if (exact < margin.left || exact > this.width - margin.right) continue;
      let py = this.top + 11;
      const half = Math.max(9, g.measureText(moment.numbers).width / 2 + 4);
      const px = Math.min(Math.max(exact, half), this.width - half);
      while (taken.some(([x, y, w]) => Math.abs(x - px) < half + w + 2 && Math.abs(y - py) < 20)) py += 20;
      taken.push([px, py, half]);
      g.fillStyle = inkOf("bad"); g.beginPath(); g.roundRect(px - half, py - 9, 2 * half, 18, 9); g.fill();
      g.fillStyle = inkOf("card"); g.textAlign = "center"; g.textBaseline = "middle"; g.fillText(moment.numbers, px, py + 0.5);
    }
  }

  drawEvents() {
    const g = this.g;
    let freeFrom = -Infinity;
    for (const event of data.events) {
      const px = Math.round(this.px(event.time)) + 0.5;
      if (px < margin.left || px > this.width - margin.right) continue;
      g.strokeStyle = g.fillStyle = inkOf(event.isBad ? "bad" : "soft"); g.lineWidth = 1;
      g.setLineDash(event.isBad ? [] : [3, 3]);
      g.beginPath(); g.moveTo(px, this.top); g.lineTo(px, this.height - margin.bottom); g.stroke();
      g.setLineDash([]);
      const name = event.id.replaceAll("_", " "), width = g.measureText(name).width;
      if (!this.namesEvents || px < freeFrom) continue;
      const isTight = px + width + 4 > this.width - margin.right;
      if (isTight && px - width - 4 < freeFrom) continue;
      g.textAlign = isTight ? "right" : "left"; g.textBaseline = "bottom";
      g.fillText(name, px, this.top - 3);
      freeFrom = px + width + 12;
    }
  }

  /// Draws the tissue first met at each depth, behind thrust over depth.
  drawBands(from, to) {
    const g = this.g;
    let deepest = -Infinity, begin = 0, tissue = -1;
    const fill = () => {
      const start = this.px(Math.max(begin, this.axis.view[0])), end = this.px(deepest), colour = colourOf(tissue);
      if (colour && end > start) { g.fillStyle = colour; g.fillRect(start, this.top, end - start, this.height); }
    };
    g.globalAlpha = 0.4;
    for (let i = from; i < to; ++i) {
      if (rows.depth[i] <= deepest) continue;
      if (rows.tissue[i] !== tissue) { fill(); begin = Math.max(deepest, rows.depth[from]); tissue = rows.tissue[i]; }
      deepest = rows.depth[i];
    }
    fill();
    g.globalAlpha = 1;
  }

  drawTissues(top, height) {
    const g = this.g, right = this.width - margin.right;
    g.fillStyle = inkOf("grid"); g.fillRect(margin.left, top, right - margin.left, height);
    for (let px = margin.left; px < right; ++px) {
      const colour = colourOf(rows.tissue[indexAt(this.xAt(px + 0.5))]);
      if (colour) { g.fillStyle = colour; g.fillRect(px, top, 1, height); }
    }
    if (cursor >= 0) { g.fillStyle = inkOf("ink"); g.fillRect(this.px(rows.time[cursor]), top - 2, 1, height + 4); }
  }

  drawCursor() {
    if (cursor < 0) return;
    const g = this.g, px = this.px(this.x[cursor]), py = this.py(this.y[cursor]);
    g.strokeStyle = inkOf("ink"); g.lineWidth = 1; g.globalAlpha = 0.5;
    g.beginPath(); g.moveTo(px, this.top); g.lineTo(px, this.height - margin.bottom); g.stroke();
    g.globalAlpha = 1; g.fillStyle = inkOf("accent-2");
    g.beginPath(); g.arc(px, py, 4, 0, 7); g.fill();
  }
}

/// Returns the last row at or before a time.
function indexAt(time) {
  let low = 0, high = count - 1;
  while (low < high) { const middle = (low + high + 1) >> 1; if (rows.time[middle] <= time) low = middle; else high = middle - 1; }
  return low;
}

function drawReadout() {
  const parts = [];
  if (cursor >= 0) {
    const i = cursor, add = (name, text) => parts.push([name, text]);
    add("time", rows.time[i].toFixed(2) + " s");
    add("depth", sensible(rows.depth[i]) + " mm");
    add("thrust", sensible(rows.thrust[i]) + " N");
    add("torque", sensible(rows.torque[i]) + " N·mm");
    if (rows.sent[i]) add("torque sent", sensible(rows.sent[i]) + " N·mm");
    add("lateral", sensible(rows.lateral[i]) + " N");
    add("tissue", rows.tissue[i] < 0 ? "none" : (data.tissues[rows.tissue[i]] || { name: "?" }).name);
    const [a, b] = timeAxis.view, near = data.events.find(e => Math.abs(e.time - rows.time[i]) < (b - a) * 0.006);
    if (near) add("event", near.id.replaceAll("_", " ") + (near.detail ? ": " + near.detail : ""));
  }
  byId("readout").replaceChildren(...parts.flatMap(([name, text]) => {
    const value = document.createElement("b");
    value.textContent = text;
    return [name + "\u00a0", value, "   "];
  }));
}

let isWaiting = false;
function later(draw) { if (!isWaiting) { isWaiting = true; requestAnimationFrame(() => { isWaiting = false; draw(); }); } }
function drawAll() { for (const plot of plots) plot.draw(); drawReadout(); }

/// The plot of one step over the depth along its own axis.
function showOneStep() {
  const choice = byId("depth-step"), load = byId("depth-load"), steps = data.steps;
  for (const [i, step] of steps.entries()) choice.add(new Option(step.title, i));
  if (!steps.length) return;
  const loads = { thrust: [rows.thrust, "thrust", "N", "thrust"], torque: [rows.torque.map(Math.abs), "torque about the shaft", "N·mm", "torque"], lateral: [rows.lateral, "force across the shaft", "N", "lateral_force"] };
  const plot = new Plot("plot-depth", new Axis(0, 1), { x: rows.depth, xName: "depth", xUnit: "mm" });
  const key = (css, text) => {
    const item = document.createElement("span"), mark = document.createElement("i");
    mark.className = "key " + css; item.append(mark, text);
    return item;
  };
  const choose = () => {
    const step = steps[choice.value], [y, name, unit, quantity] = loads[load.value];
    const [shallow, deep] = rangeOf(rows.depth, step.begin, step.end, () => true);
    const end = Math.max(deep, ...step.depths.map(line => line.value));
    Object.assign(plot, { shown: step, y, name, unit, limits: step.limits[quantity] || [] });
    plot.axis = new Axis(Math.max(shallow, -0.15 * Math.max(deep, 1)), Math.max(end * 1.03, shallow + 1e-3));
    byId("depth-legend").replaceChildren(key("inwards", "moving in"), key("outwards", "moving out"),
      ...plot.limits.concat(step.depths).map(line => key(line.isGoal ? "goal" : "limit", line.text)));
    later(drawAll);
  };
  for (const select of [choice, load]) select.addEventListener("change", choose);
  choose();
}

const timeAxis = new Axis(count ? rows.time[0] : 0, count ? rows.time[count - 1] : 1);
if (count) {
  const time = { x: rows.time, xName: "time", xUnit: "s", isTime: true };
  showOneStep();
  new Plot("plot-1", timeAxis, { ...time, y: rows.thrust, name: "thrust", unit: "N", namesEvents: true });
  new Plot("plot-2", timeAxis, { ...time, y: rows.torque, name: "torque about the shaft", unit: "N·mm" });
  new Plot("plot-3", timeAxis, { ...time, y: rows.lateral, name: "force across the shaft", unit: "N" });
  new Plot("plot-4", timeAxis, { ...time, y: rows.depth, name: "depth", unit: "mm" });
  new Plot("plot-strip", timeAxis, { isStrip: true });
  if (data.signals.length) {
    const choice = byId("signal"), over = byId("signal-over");
    const torque = data.signals.findIndex(s => s.name === "torque"), angle = data.signals.findIndex(s => s.unit === "°");
    const varies = s => s >= 0 && data.signals[s].values.some(v => v !== data.signals[s].values[0]);
    if (varies(torque) && varies(angle)) { choice.value = torque; over.value = angle; }  // the usual plot for a screw
    else choice.value = Math.max(0, data.signals.findIndex((_, s) => varies(s)));
    const plot = new Plot("plot-5", timeAxis, { ...time, y: data.signals[0].values, name: "", unit: "" });
    const across = s => ({ x: s.values, xName: s.name, xUnit: s.unit, isTime: false, axis: new Axis(...rangeOf(s.values, 0, count, () => true)) });
    const choose = () => {
      const s = data.signals[choice.value], x = data.signals[over.value];
      Object.assign(plot, { y: s.values, name: s.name, unit: s.unit }, x ? across(x) : { ...time, axis: timeAxis });
      later(drawAll);
    };
    for (const select of [choice, over]) select.addEventListener("change", choose);
    choose();
  }
  for (const link of document.querySelectorAll("a[data-time]"))
    link.addEventListener("click", () => { cursor = indexAt(Number(link.dataset.time)); later(drawAll); });
  drawAll();
  window.addEventListener("resize", () => later(drawAll));
}

// ---- the bone -------------------------------------------------------------------------------------------------

const vertexShader = `#version 300 es
in vec3 position, normal; in float tissue;
uniform mat4 clipFromBone; uniform vec3 colours[16], centre; uniform float unit;
out vec3 at, facing, colour;
void main() { at = position * unit + centre; facing = normal; colour = colours[int(clamp(tissue, 0.0, 15.0))];
  gl_Position = clipFromBone * vec4(at, 1.0); }`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 at, facing, colour; out vec4 result;
uniform vec4 cut; uniform vec3 eye, limit; uniform float alpha;
void main() {
  if (dot(cut.xyz, at) > cut.w || any(greaterThan(abs(at), limit))) discard;
  vec3 n = normalize(facing), toEye = normalize(eye - at);
  bool isInside = !gl_FrontFacing;               // the inner side of the surface, seen through the cut
  if (isInside) n = -n;
  float light = 0.46 + 0.46 * max(dot(n, toEye), 0.0) + 0.08 * n.z;
  vec3 c = isInside ? mix(colour, vec3(0.45, 0.2, 0.16), 0.55) : colour;
  result = vec4(c * light, alpha); }`;

function multiply(a, b) {  // column-major 4 × 4
  const c = new Float32Array(16);
  for (let i = 0; i < 4; ++i) for (let j = 0; j < 4; ++j) for (let k = 0; k < 4; ++k) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
  return c;
}
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const towards = view => [Math.cos(view.pitch) * Math.cos(view.yaw), Math.cos(view.pitch) * Math.sin(view.yaw), Math.sin(view.pitch)];
const unitOf = a => { const l = Math.hypot(...a) || 1; return a.map(v => v / l); };

function showBone() {
  const mesh = data.mesh, canvas = byId("bone"), fallback = byId("bone-text");
  if (!mesh) { fallback.textContent = "This run left no surface to show."; return; }
  const gl = canvas.getContext("webgl2", { alpha: true, antialias: true, stencil: true, preserveDrawingBuffer: true });
  if (!gl) { fallback.textContent = "The bone in 3D needs WebGL 2, which is off in this browser. The same surface is in bone.stl."; return; }
  fallback.hidden = true; byId("bone-view").hidden = false;

  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(program, shader);
  }
  gl.linkProgram(program); gl.useProgram(program);
  const bone = gl.createVertexArray();
  gl.bindVertexArray(bone);
  const feed = (name, values, size, type, isNormalised) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    const slot = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(slot); gl.vertexAttribPointer(slot, size, type, isNormalised, 0, 0);
  };
  feed("position", decode(mesh.positions, Int16Array), 4, gl.SHORT, false);   // padded to four
  feed("normal", decode(mesh.normals, Int8Array), 4, gl.BYTE, true);
  feed("tissue", decode(mesh.tissue, Uint8Array), 1, gl.UNSIGNED_BYTE, false);
  const triangles = decode(mesh.triangles, mesh.isShort ? Uint16Array : Uint32Array);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  const zones = data.zones.map(zone => {
    const object = gl.createVertexArray();
    gl.bindVertexArray(object);
    feed("position", decode(zone.positions, Int16Array), 4, gl.SHORT, false);
    feed("normal", decode(zone.normals, Int8Array), 4, gl.BYTE, true);
    const corners = decode(zone.triangles, zone.isShort ? Uint16Array : Uint32Array);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    const colour = [1, 3, 5].map(k => parseInt(zone.colour.slice(k, k + 2), 16) / 255);
    return { ...zone, object, count: corners.length, type: zone.isShort ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, colours: new Float32Array(48).map((_, i) => colour[i % 3]) };
  });
  gl.enable(gl.DEPTH_TEST);

  const uniform = name => gl.getUniformLocation(program, name);
  const colours = new Float32Array(48).fill(0.8);
  data.tissues.slice(0, 16).forEach((t, i) => colours.set([1, 3, 5].map(k => parseInt(t.colour.slice(k, k + 2), 16) / 255), 3 * i));

  const half = mesh.halfSize, radius = Math.hypot(...half);
  const look = mesh.look, start = { yaw: Math.atan2(look[1], look[0]) + 0.45, pitch: clamp(Math.asin(clamp(look[2], -1, 1)) + 0.35, -1.1, 1.1), distance: radius };
  {  // the nearest distance at which all corners of the bone's box are in the picture
    const back = towards(start), right = unitOf(cross([0, 0, 1], back)), up = cross(back, right);
    const tall = 0.92 * Math.tan(0.26), wide = tall * canvas.clientWidth / Math.max(1, canvas.clientHeight);
    for (let i = 0; i < 8; ++i) {
      const corner = half.map((h, axis) => (i >> axis) & 1 ? h : -h);
      start.distance = Math.max(start.distance, dot(corner, back) + Math.abs(dot(corner, right)) / wide, dot(corner, back) + Math.abs(dot(corner, up)) / tall);
    }
  }
  let view = { ...start, shift: [0, 0] };
  const toFirstEye = towards(start);  // the half towards the first view is removed, to show the inside
  const axisChoice = byId("cut-axis"), slider = byId("cut-at"), flip = byId("cut-flip");

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio); canvas.height = Math.round(canvas.clientHeight * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);

    const back = towards(view);
    const right = unitOf(cross([0, 0, 1], back)), up = cross(back, right);
    const centre = [0, 1, 2].map(i => right[i] * view.shift[0] + up[i] * view.shift[1]);
    const eye = [0, 1, 2].map(i => centre[i] + back[i] * view.distance);
    const eyeFromBone = new Float32Array([right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1]);
    const near = Math.max(view.distance - 2 * radius - Math.hypot(...view.shift), view.distance * 0.02), far = view.distance + 2 * radius + Math.hypot(...view.shift);
    const f = 1 / Math.tan(0.26), aspect = canvas.width / Math.max(1, canvas.height);
    const clipFromEye = new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0, -2 * far * near / (far - near), 0]);
    gl.uniformMatrix4fv(uniform("clipFromBone"), false, multiply(clipFromEye, eyeFromBone));
    gl.uniform3fv(uniform("eye"), eye);

    const axis = Number(axisChoice.value), sign = (toFirstEye[axis] < 0) === flip.checked ? 1 : -1, normal = [0, 0, 0];
    normal[axis] = sign;
    gl.uniform4f(uniform("cut"), ...normal, half[axis] * (1.001 - 2.002 * Number(slider.value) / 100));
    gl.bindVertexArray(bone);
    gl.uniform3fv(uniform("colours"), colours); gl.uniform1f(uniform("unit"), mesh.unit); gl.uniform3f(uniform("centre"), 0, 0, 0);
    gl.uniform3f(uniform("limit"), 1e9, 1e9, 1e9); gl.uniform1f(uniform("alpha"), 1);
    gl.drawElements(gl.TRIANGLES, triangles.length, mesh.isShort ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, 0);
    drawZones();
    drawMarks(p => {  // the pixel of a point
      const d = p.map((v, i) => v - eye[i]), far = -dot(back, d);
      return far > 0 ? [(0.5 + 0.5 * f / aspect * dot(right, d) / far) * canvas.clientWidth, (0.5 - 0.5 * f * dot(up, d) / far) * canvas.clientHeight] : null;
    });

    // The patient's directions: left, posterior, superior
    [["L", [1, 0, 0]], ["P", [0, 1, 0]], ["S", [0, 0, 1]]].forEach(([name, v]) => {
      const x = 37 + 24 * dot(right, v), y = 37 - 24 * dot(up, v), line = byId("axis-" + name), text = byId("axis-name-" + name);
      line.setAttribute("x2", x); line.setAttribute("y2", y);
      text.setAttribute("x", 37 + 31 * dot(right, v)); text.setAttribute("y", 37 - 31 * dot(up, v));
    });
  }

  /// Draws zones over the bone: the parts behind it paler. Of each zone, a pixel gets the nearest surface once.
  function drawZones() {
    const each = (alpha, before) => zones.forEach((zone, i) => {
      gl.bindVertexArray(zone.object);
      gl.uniform3fv(uniform("colours"), zone.colours); gl.uniform1f(uniform("unit"), zone.unit); gl.uniform3f(uniform("centre"), ...zone.centre);
      gl.uniform4f(uniform("cut"), 0, 0, 0, 1);  // zones stay whole where bone is cut away
      gl.uniform3f(uniform("limit"), ...half.map(h => h + 8)); gl.uniform1f(uniform("alpha"), alpha);
      if (before) before(i);
      gl.drawElements(gl.TRIANGLES, zone.count, zone.type, 0);
    });
    gl.enable(gl.BLEND); gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.enable(gl.POLYGON_OFFSET_FILL); gl.polygonOffset(1, 1);  // a zone on the surface of bone is behind it
    gl.enable(gl.STENCIL_TEST); gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE); gl.depthMask(false);
    gl.depthFunc(gl.GREATER); each(0.3, i => gl.stencilFunc(gl.NOTEQUAL, i + 1, 255));
    gl.disable(gl.STENCIL_TEST); gl.depthMask(true); gl.colorMask(false, false, false, false);
    gl.depthFunc(gl.LESS); each(1);
    gl.colorMask(true, true, true, true); gl.depthMask(false);
    gl.depthFunc(gl.EQUAL); each(0.6);
    gl.depthMask(true); gl.depthFunc(gl.LESS); gl.disable(gl.BLEND); gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  /// Writes the names of zones and approaches next to their points, apart from each other.
  function drawMarks(pixelOf) {
    const svg = byId("marks"), width = canvas.clientWidth, height = canvas.clientHeight, taken = [[0, height - 90, 90, height]];
    const node = (name, attributes, text) => {
      const one = document.createElementNS("http://www.w3.org/2000/svg", name);
      for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
      if (text) one.textContent = text;
      return svg.appendChild(one);
    };
    const isFree = box => box[0] >= 2 && box[1] >= 2 && box[2] <= width - 2 && box[3] <= height - 2 && taken.every(o => box[2] <= o[0] || o[2] <= box[0] || box[3] <= o[1] || o[3] <= box[1]);
    const write = (at, text, colour) => {
      const label = node("text", { x: 0, y: 0, style: "fill:" + colour }, text), w = label.getComputedTextLength(), h = 16;
      for (let ring = 14; ring < 220; ring += 8)
        for (const [sx, sy] of [[1, 0], [-1, 0], [1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1], [0, 1]]) {
          const x = at[0] + sx * (ring + w / 2) - w / 2, y = at[1] + sy * (ring + h / 2) - h / 2, box = [x, y, x + w, y + h];
          if (!isFree(box)) continue;
          taken.push(box); label.setAttribute("x", x); label.setAttribute("y", y + 12);
          return;
        }
      label.remove();
    };
    svg.replaceChildren();
    const marks = data.approaches.map(approach => [pixelOf(approach.at), approach]).filter(([at]) => at && at[0] > 0 && at[0] < width && at[1] > 0 && at[1] < height);
    for (const [at, approach] of marks) {
      const colour = inkOf(approach.isBad ? "bad" : "good");
      node("circle", { cx: at[0], cy: at[1], r: 10, fill: "none", stroke: inkOf("page"), "stroke-width": 5 });
      node("circle", { cx: at[0], cy: at[1], r: 10, fill: "none", stroke: colour, "stroke-width": 2.5 });
      taken.push([at[0] - 12, at[1] - 12, at[0] + 12, at[1] + 12]);
    }
    for (const [at, approach] of marks) write(at, approach.text, inkOf(approach.isBad ? "bad" : "good"));
    for (const zone of zones) {  // at the end of the zone that is higher in the picture
      const ends = [-1, 1].map(side => pixelOf(zone.centre.map((c, i) => clamp(c + (zone.halfSize[i] === Math.max(...zone.halfSize) ? side * zone.halfSize[i] : 0), -half[i] - 8, half[i] + 8))));
      const at = ends.filter(end => end && end[0] > 0 && end[0] < width && end[1] > 0 && end[1] < height).sort((a, b) => a[1] - b[1])[0];
      if (at) write(at, zone.name, zone.colour);
    }
  }

  let held = null;
  canvas.addEventListener("pointerdown", e => { held = [e.clientX, e.clientY, e.shiftKey || e.button === 2]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointermove", e => {
    if (!held) return;
    const dx = e.clientX - held[0], dy = e.clientY - held[1], scale = view.distance * 0.53 / canvas.clientHeight;
    if (held[2]) { view.shift[0] -= dx * scale; view.shift[1] += dy * scale; }
    else { view.yaw -= dx * 0.008; view.pitch = clamp(view.pitch + dy * 0.008, -1.55, 1.55); }
    held[0] = e.clientX; held[1] = e.clientY;
    requestAnimationFrame(draw);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  canvas.addEventListener("wheel", e => { e.preventDefault(); view.distance = clamp(view.distance * Math.exp(e.deltaY * 0.001), radius * 0.15, radius * 20); requestAnimationFrame(draw); }, { passive: false });
  canvas.addEventListener("dblclick", () => { view = { ...start, shift: [0, 0] }; requestAnimationFrame(draw); });
  canvas.addEventListener("keydown", e => {
    const keys = { ArrowLeft: [0.1, 0, 1], ArrowRight: [-0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1], "+": [0, 0, 0.9], "-": [0, 0, 1 / 0.9] };
    if (!keys[e.key]) return;
    e.preventDefault();
    const [yaw, pitch, nearer] = keys[e.key];
    view.yaw += yaw; view.pitch = clamp(view.pitch + pitch, -1.55, 1.55); view.distance = clamp(view.distance * nearer, radius * 0.15, radius * 20);
    requestAnimationFrame(draw);
  });
  for (const input of [axisChoice, slider, flip]) input.addEventListener("input", () => requestAnimationFrame(draw));
  window.addEventListener("resize", () => requestAnimationFrame(draw));
  window.addEventListener("beforeprint", draw);
  draw();
}
showBone();

// For paper: a white page, with all details open.
const folded = [...document.querySelectorAll("details:not([open])")];
window.addEventListener("beforeprint", () => {
  document.documentElement.classList.add("light");
  for (const one of folded) one.dataset.wasOpen = one.open, one.open = true;
  if (count) drawAll();
});
window.addEventListener("afterprint", () => {
  document.documentElement.classList.remove("light");
  for (const one of folded) one.open = one.dataset.wasOpen === "true";
  if (count) drawAll();
});
