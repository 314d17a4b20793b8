// The viewer of preview.html: one file, no network, no library. Units: mm, z up.
'use strict';
(async () => {
const $ = id => document.getElementById(id);
const canvas = $('view');
const gl = canvas.getContext('webgl2', { antialias: true, alpha: true, premultipliedAlpha: true });
if (!gl || typeof DecompressionStream === 'undefined') {
  $('fallback').hidden = false;
  canvas.hidden = true;
  document.querySelector('footer').hidden = true;
  return;
}

// Reading the data: a JSON header, then arrays whose bytes are sorted by significance.
const packed = Uint8Array.from(atob($('data').textContent.trim()), c => c.charCodeAt(0));
const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
const headerSize = new DataView(bytes.buffer).getUint32(0, true);
const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + headerSize)));
let at = 4 + headerSize;
const take = (count, size) => {
  const out = new Int32Array(count);
  for (let b = 0; b < size; ++b) {
    for (let i = 0; i < count; ++i) out[i] |= bytes[at++] << (8 * b);
  }
  const shift = 32 - 8 * size;
  for (let i = 0; i < count; ++i) out[i] = out[i] << shift >> shift;
  return out;
};
const { points: n, rim, triangles: nt, modes: K, elements: N, unit, steps } = head;
const triangles = take(3 * nt, 2);
for (let i = 1; i < triangles.length; ++i) triangles[i] += triangles[i - 1];
const flat = take(2 * n, 2), mean = take(3 * n, 2), meanNormal = take(3 * n, 1);
const modes = [];
for (let k = 0; k < K; ++k) modes.push(take(3 * n, 2));
const origin = take(3 * N, 4), turn = take(4 * N, 2), facing = take(N, 1), component = take(N, 2);
const weights = [];
for (let k = 0; k < K; ++k) weights.push(take(N, 2));
const neighbours = take(4 * N, 4);

// Every element's points: mean shape, plus modes, turned (and mirrored when flipped) into place.
const P = new Float32Array(3 * n * N), M = new Float32Array(3 * n * N);
const local = new Float32Array(3 * n), normal = new Float32Array(3 * n);
const rotation = e => {
  const [x, y, z, w] = [0, 1, 2, 3].map(k => turn[4 * e + k] / 32767);
  const s = 2 / (x * x + y * y + z * z + w * w), m = facing[e] ? -1 : 1;
  return [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w),
    m * s * (x * z - y * w), m * s * (y * z + x * w), m * (1 - s * (x * x + y * y))];
};
const transform = (R, o, from, to, start) => {
  for (let i = 0; i < n; ++i) {
    const x = from[3 * i], y = from[3 * i + 1], z = from[3 * i + 2];
    for (let r = 0; r < 3; ++r) to[start + 3 * i + r] = R[3 * r] * x + R[3 * r + 1] * y + R[3 * r + 2] * z + o[r];
  }
};
const shape = (e, flatness) => {
  const keep = 1 - flatness;
  for (let i = 0; i < 3 * n; ++i) local[i] = mean[i] * keep * unit;
  for (let k = 0; k < K; ++k) {
    const w = weights[k][e] * head.scales[k] * keep;
    if (w) for (let i = 0; i < 3 * n; ++i) local[i] += w * modes[k][i];
  }
  if (flatness) for (let i = 0; i < n; ++i) { local[3 * i] += flatness * flat[2 * i] * unit; local[3 * i + 1] += flatness * flat[2 * i + 1] * unit; }
};
const place = (e, out, start, flatness, lift) => {
  const R = rotation(e), o = [0, 1, 2].map(r => origin[3 * e + r] * unit + lift * R[3 * r + 2]);
  shape(e, flatness);
  transform(R, o, local, out, start);
};
for (let i = 0; i < 3 * n; ++i) normal[i] = meanNormal[i] / 127;
for (let e = 0; e < N; ++e) {
  place(e, P, 3 * n * e, 0, 0);
  transform(rotation(e), [0, 0, 0], normal, M, 3 * n * e);
}
const centre = [0, 0, 0], middles = [];
const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
for (let e = 0; e < N; ++e) {
  const c = [0, 0, 0];
  for (let i = 0; i < n; ++i) for (let r = 0; r < 3; ++r) {
    const v = P[3 * (n * e + i) + r];
    c[r] += v / n;
    if (e < head.final) { low[r] = Math.min(low[r], v); high[r] = Math.max(high[r], v); }
  }
  middles.push(c);
}
for (let r = 0; r < 3; ++r) centre[r] = (low[r] + high[r]) / 2;
let radius = 1;
for (let i = 0; i < 3 * n * head.final; i += 3) radius = Math.max(radius, Math.hypot(P[i] - centre[0], P[i + 1] - centre[1], P[i + 2] - centre[2]));

// The drawing.
const compile = (type, text) => {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, '#version 300 es\nprecision highp float;\n' + text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
};
const program = gl.createProgram();
gl.attachShader(program, compile(gl.VERTEX_SHADER, `
layout(location=0) in vec3 point; layout(location=1) in vec3 across; layout(location=2) in vec2 sheet;
uniform mat4 camera; uniform vec3 shift; out vec3 place; out vec3 side; out vec2 uv;
void main() { place = point + shift; side = across; uv = sheet; gl_Position = camera * vec4(place, 1.); }`));
gl.attachShader(program, compile(gl.FRAGMENT_SHADER, `
in vec3 place; in vec3 side; in vec2 uv; out vec4 color;
uniform vec3 eye, key, fill, bulb, tint; uniform float lamp, radius, stripes, alpha, line, pulse;
void main() {
  if (line > 0.) { color = vec4(mix(vec3(.13, .11, .1), vec3(.45, .2, .05), lamp) * alpha * line, alpha * line); return; }
  vec3 view = normalize(eye - place), n = normalize(side);
  bool inside = dot(n, view) < 0.;
  if (inside) n = -n;
  vec3 base = pow(tint, vec3(2.2));
  float band = abs(fract((uv.x + uv.y) / 9.) - .5) * 2.;
  if (stripes > 0.) base *= mix(1., stripes > 1.5 ? .45 : .84, smoothstep(.42, .58, band));
  float wrap = max(0., (dot(n, key) + .25) / 1.25), side2 = max(0., (dot(n, fill) + .4) / 1.4), sky = .5 + .5 * n.z;
  vec3 light = mix(vec3(.24, .2, .17), vec3(.36, .4, .46), sky) + wrap * vec3(.78, .74, .66) + side2 * vec3(.16, .17, .2);
  float gloss = pow(max(0., dot(n, normalize(view + key))), 60.);
  vec3 cold = base * light * (inside ? .5 : 1.) + .2 * gloss;
  vec3 to = bulb - place; float far = length(to), face = abs(dot(n, to)) / max(far, 1.);
  vec3 warm = base * vec3(1., .64, .28) * (inside ? 1.2 : .75) * pow(.7 * radius / max(far, .3 * radius), 1.2) * (.25 + .85 * face * face);
  vec3 c = mix(cold, .16 * cold + warm, lamp) * (1. + pulse);
  c = mix(c, .7 + .3 * (1. - exp(-(c - .7) / .3)), step(.7, c));
  color = vec4(pow(c, vec3(1. / 2.2)) * alpha, alpha);
}`));
gl.linkProgram(program);
gl.useProgram(program);
const uniform = {};
for (const name of 'camera shift eye key fill bulb tint lamp radius stripes alpha line pulse'.split(' ')) uniform[name] = gl.getUniformLocation(program, name);
const buffer = (target, data, usage) => { const b = gl.createBuffer(); gl.bindBuffer(target, b); gl.bufferData(target, data, usage || gl.STATIC_DRAW); return b; };
const attribute = (index, data, size) => {
  const b = buffer(gl.ARRAY_BUFFER, data);
  gl.enableVertexAttribArray(index);
  gl.vertexAttribPointer(index, size, gl.FLOAT, false, 0, 0);
  return b;
};
const pointBuffer = attribute(0, P, 3);
attribute(1, M, 3);
const UV = new Float32Array(2 * n * N);
for (let e = 0; e < N; ++e) for (let i = 0; i < 2 * n; ++i) UV[2 * n * e + i] = flat[i] * unit * 80 / head.la;
attribute(2, UV, 2);
const indices = new Uint32Array(N * (3 * nt + 2 * rim));
for (let e = 0, k = 0; e < N; ++e) for (let i = 0; i < 3 * nt; ++i) indices[k++] = n * e + triangles[i];
for (let e = 0, k = 3 * nt * N; e < N; ++e) for (let i = 0; i < rim; ++i) { indices[k++] = n * e + i; indices[k++] = n * e + (i + 1) % rim; }
buffer(gl.ELEMENT_ARRAY_BUFFER, indices);
gl.enable(gl.DEPTH_TEST);
gl.enable(gl.BLEND);
gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
gl.enable(gl.POLYGON_OFFSET_FILL);
gl.polygonOffset(1, 2);

// What is shown.
const start = { yaw: 0.64, pitch: 0.42, distance: radius / Math.sin(0.21) * 1.04, target: [...centre] };
const camera = { ...start };
const finished = steps.length + 1;
const state = { step: finished, lamp: head.lit ? 1 : 0, explode: 0, chosen: -1, isolated: false, hidden: new Set(), motion: 0, playing: 0 };
const present = new Array(N).fill(true);
const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
const kinds = ['Insert', 'Remove', 'Unhook', 'Hook in'];
const active = () => state.step < finished ? steps[state.step - 1] : null;
const name = e => e < head.final ? 'E' + String(e + 1).padStart(3, '0') : 'T' + (e - head.final + 1) + ' (taken out again)';
const visible = e => (present[e] || (active() && active()[1] === e)) && !state.hidden.has(e) &&
  (!state.isolated || e === state.chosen || around(state.chosen).includes(e));
const around = e => e < 0 ? [] : [...neighbours.subarray(4 * e, 4 * e + 4)].filter(f => f >= 0);
const look = e => {
  const step = active();
  if (step && step[1] === e) return { tint: step[0] === 1 ? [.45, .45, .5] : step[0] === 0 ? [.86, .12, .1] : [.95, .6, .05], stripes: 2, alpha: step[0] === 1 ? .55 : 1 };
  if (e === state.chosen) return { tint: [.2, .5, .9], stripes: 2, alpha: 1 };
  return facing[e] ? { tint: [.93, .67, .45], stripes: 1, alpha: 1 } : { tint: [.95, .92, .86], stripes: 0, alpha: 1 };
};

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unitVector = a => { const l = Math.hypot(...a) || 1; return a.map(v => v / l); };
const axes = () => {
  const c = Math.cos(camera.pitch), back = [c * Math.sin(camera.yaw), -c * Math.cos(camera.yaw), Math.sin(camera.pitch)];
  const right = [Math.cos(camera.yaw), Math.sin(camera.yaw), 0];
  return { back, right, up: cross(back, right), eye: back.map((b, r) => camera.target[r] + b * camera.distance) };
};
const tangent = () => Math.tan(0.21) * Math.max(1 / (1 - covered()), canvas.clientHeight / Math.max(1, canvas.clientWidth));
// The model stands in the part of the screen that the controls leave free.
const covered = () => Math.min(.45, $('footer').offsetHeight / Math.max(1, canvas.clientHeight));
const matrix = a => {
  const near = Math.max(1, camera.distance - 4 * radius), far = camera.distance + 6 * radius, t = tangent(), aspect = canvas.width / canvas.height;
  const rows = [a.right.map(v => v / (t * aspect)), a.up.map(v => v / t), a.back.map(v => -v * (far + near) / (far - near)), a.back.map(v => -v)];
  const offset = [0, 0, 2 * far * near / (near - far), 0];
  const m = new Float32Array(16);
  const shift = covered();
  rows[1] = rows[1].map((v, c) => v + shift * rows[3][c]);
  rows.forEach((row, r) => { row.forEach((v, c) => { m[4 * c + r] = v; }); m[12 + r] = offset[r] - dot(row, a.eye); });
  return m;
};
const shiftOf = e => middles[e].map((v, r) => (v - centre[r]) * state.explode);

let wanted = false;
let afterwards = () => {};
const redraw = () => { if (!wanted) { wanted = true; requestAnimationFrame(draw); } };
function draw() {
  wanted = false;
  const ratio = Math.min(devicePixelRatio || 1, 2), w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  gl.viewport(0, 0, w, h);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const a = axes();
  gl.uniformMatrix4fv(uniform.camera, false, matrix(a));
  gl.uniform3fv(uniform.eye, a.eye);
  gl.uniform3fv(uniform.key, unitVector(a.back.map((b, r) => .75 * b + .85 * a.up[r] - .7 * a.right[r])));
  gl.uniform3fv(uniform.fill, unitVector(a.back.map((b, r) => .6 * b + .1 * a.up[r] + .9 * a.right[r])));
  gl.uniform3fv(uniform.bulb, centre);
  gl.uniform1f(uniform.radius, radius);
  gl.uniform1f(uniform.lamp, state.lamp);
  const order = [];
  for (let e = 0; e < N; ++e) if (visible(e)) order.push([e, look(e)]);
  order.sort((p, q) => q[1].alpha - p[1].alpha);
  for (const [e, l] of order) {
    gl.uniform3fv(uniform.shift, shiftOf(e));
    gl.uniform3fv(uniform.tint, l.tint);
    gl.uniform1f(uniform.stripes, l.stripes);
    gl.uniform1f(uniform.alpha, l.alpha);
    gl.uniform1f(uniform.pulse, l.stripes > 1 ? .12 : 0);
    gl.uniform1f(uniform.line, 0);
    gl.drawElements(gl.TRIANGLES, 3 * nt, gl.UNSIGNED_INT, 12 * nt * e);
    gl.uniform1f(uniform.line, l.stripes > 1 ? 1 : .55);
    gl.drawElements(gl.LINES, 2 * rim, gl.UNSIGNED_INT, 4 * (3 * nt * N + 2 * rim * e));
  }
  afterwards(a);
}

// Steps: what stands before a step, and the piece of the step on its way.
const upload = (e, flatness, lift) => {
  place(e, P, 3 * n * e, flatness, lift);
  gl.bindBuffer(gl.ARRAY_BUFFER, pointBuffer);
  gl.bufferSubData(gl.ARRAY_BUFFER, 12 * n * e, P.subarray(3 * n * e, 3 * n * (e + 1)));
};
// Turn far enough that an element on the far side comes into sight.
const face = e => {
  const d = unitVector(middles[e].map((v, r) => v - centre[r])), a = axes();
  if (dot(d, a.back) > .35 || Math.hypot(d[0], d[1]) < .2) return;
  camera.yaw = Math.atan2(d[0], -d[1]) - .4;
};
let moving = -1;
const settle = () => { cancelAnimationFrame(state.motion); if (moving >= 0) upload(moving, 0, 0); moving = -1; };
const animate = (e, away) => {
  settle();
  if (calm) return;
  moving = e;
  const begin = performance.now(), time = state.playing ? 450 : 900;
  const frame = now => {
    const t = Math.min(1, (now - begin) / time), s = away ? t : 1 - t;
    upload(e, Math.min(1, Math.max(0, 2 * s - 1)), head.la * .9 * s * s);
    redraw();
    if (t < 1) state.motion = requestAnimationFrame(frame); else if (!away) moving = -1;
  };
  frame(begin);
};
const show = (step, silent) => {
  state.step = Math.max(1, Math.min(finished, Math.round(step) || finished));
  for (let e = 0; e < N; ++e) present[e] = steps.length ? false : e < head.final;
  for (let i = 0; i < state.step - 1; ++i) {
    if (steps[i][0] === 0) present[steps[i][1]] = true;
    if (steps[i][0] === 1) present[steps[i][1]] = false;
  }
  if (state.step === finished) for (let e = 0; e < head.final; ++e) present[e] = true;
  const s = active();
  $('step').value = state.step;
  $('label').textContent = s ? `Step ${state.step} of ${steps.length}: ${kinds[s[0]]} ${name(s[1])} (${facing[s[1]] ? 'flipped' : 'front'}), ${s[2]} ${s[2] === 1 ? 'side' : 'sides'}` :
    `Finished: ${head.final} elements`;
  if (!silent) { try { history.replaceState(null, '', s ? '#step=' + state.step : '#'); } catch { /* some browsers refuse it for files */ } }
  settle();
  if (s) face(s[1]);
  if (s && s[0] < 2) animate(s[1], s[0] === 1);
  redraw();
};
const play = on => {
  clearInterval(state.playing);
  state.playing = 0;
  if (on) {
    if (state.step === finished) show(1);
    state.playing = setInterval(() => { if (state.step >= finished) play(false); else show(state.step + 1); }, 700);
  }
  $('play').setAttribute('aria-pressed', String(!!on));
};
const choose = e => {
  state.chosen = e;
  if (e < 0) state.isolated = false;
  const box = $('info');
  box.hidden = e < 0;
  $('hide').disabled = $('isolate').disabled = e < 0;
  $('isolate').setAttribute('aria-pressed', String(state.isolated));
  box.replaceChildren();
  if (e >= 0) {
    const add = (tag, text, parent) => { const node = document.createElement(tag); node.textContent = text; (parent || box).append(node); return node; };
    add('h2', 'Element ' + name(e));
    add('p', facing[e] ? 'flipped (the front looks inside)' : 'front outside');
    const step = steps.findLastIndex ? steps.findLastIndex(s => s[0] === 0 && s[1] === e) : steps.map(s => s[0] === 0 && s[1] === e).lastIndexOf(true);
    if (step >= 0) add('button', 'Inserted in step ' + (step + 1)).onclick = () => { play(false); show(step + 1); };
    add('p', 'Part: ' + head.components[component[e]]);
    const row = add('p', 'Neighbours: ');
    for (const f of around(e)) { const b = add('button', name(f), row); b.onclick = () => choose(f); row.append(' '); }
    if (!around(e).length) row.append('none');
  }
  redraw();
};

// The element under a place of the screen: a ray against all visible triangles.
const pick = (x, y) => {
  const box = canvas.getBoundingClientRect(), a = axes(), t = tangent();
  const sx = (2 * (x - box.left) / box.width - 1) * t * box.width / box.height, sy = (1 - 2 * (y - box.top) / box.height - covered()) * t;
  const d = a.right.map((r, k) => r * sx + a.up[k] * sy - a.back[k]);
  let best = Infinity, found = -1;
  for (let e = 0; e < N; ++e) {
    if (!visible(e)) continue;
    const s = shiftOf(e), o = a.eye.map((v, k) => v - s[k]);
    for (let f = 0; f < nt; ++f) {
      const [i, j, k] = [0, 1, 2].map(c => 3 * (n * e + triangles[3 * f + c]));
      const p = [P[i], P[i + 1], P[i + 2]], u = [P[j] - p[0], P[j + 1] - p[1], P[j + 2] - p[2]], v = [P[k] - p[0], P[k + 1] - p[1], P[k + 2] - p[2]];
      const h = cross(d, v), det = dot(u, h);
      if (Math.abs(det) < 1e-9) continue;
      const q = o.map((c, r) => c - p[r]), b1 = dot(q, h) / det, g = cross(q, u), b2 = dot(d, g) / det, far = dot(v, g) / det;
      if (b1 >= 0 && b2 >= 0 && b1 + b2 <= 1 && far > 0 && far < best) { best = far; found = e; }
    }
  }
  return found;
};

// Hands: one finger or the mouse turns, two fingers zoom and move, the wheel zooms.
const turnBy = (dx, dy) => { camera.yaw -= dx; camera.pitch = Math.max(-1.5, Math.min(1.5, camera.pitch + dy)); redraw(); };
const zoomBy = factor => { camera.distance = Math.max(.2 * radius, Math.min(20 * radius, camera.distance * factor)); redraw(); };
const panBy = (dx, dy) => {
  const a = axes(), s = 2 * tangent() * camera.distance / canvas.clientHeight;
  camera.target = camera.target.map((v, r) => v + s * (dy * a.up[r] - dx * a.right[r]));
  redraw();
};
const touches = new Map();
let travelled = 0;
canvas.onpointerdown = e => { canvas.setPointerCapture(e.pointerId); touches.set(e.pointerId, e); if (touches.size === 1) travelled = 0; };
canvas.onpointermove = e => {
  const before = touches.get(e.pointerId);
  if (!before) return;
  const dx = e.clientX - before.clientX, dy = e.clientY - before.clientY;
  travelled += Math.abs(dx) + Math.abs(dy);
  if (touches.size === 2) {
    const other = [...touches.entries()].find(([id]) => id !== e.pointerId)[1];
    const span = p => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY) || 1;
    zoomBy(span(before) / span(e));
    panBy(dx / 2, dy / 2);
  } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) panBy(dx, dy);
  else turnBy(dx * .008, dy * .008);
  touches.set(e.pointerId, e);
};
canvas.onpointerup = e => {
  touches.delete(e.pointerId);
  if (travelled < 6 && touches.size === 0 && e.button === 0) choose(pick(e.clientX, e.clientY));
};
canvas.onpointercancel = e => touches.delete(e.pointerId);
canvas.oncontextmenu = e => e.preventDefault();
canvas.addEventListener('wheel', e => { e.preventDefault(); zoomBy(Math.exp(e.deltaY * .0012)); }, { passive: false });

const lamp = on => { state.lamp = on ? 1 : 0; document.body.classList.toggle('lit', !!on); $('lamp').setAttribute('aria-pressed', String(!!on)); redraw(); };
const explode = v => { state.explode = v; $('explode').value = v; redraw(); };
const hide = () => { if (state.chosen >= 0) { state.hidden.add(state.chosen); choose(-1); } };
const isolate = () => { if (state.chosen >= 0) { state.isolated = !state.isolated; choose(state.chosen); } };
const showAll = () => { state.hidden.clear(); choose(-1); explode(0); };
const home = () => { Object.assign(camera, start, { target: [...centre] }); redraw(); };
const go = by => { play(false); show(state.step + by); };
$('first').onclick = () => { play(false); show(1); };
$('last').onclick = () => { play(false); show(finished); };
$('back').onclick = () => go(-1);
$('next').onclick = () => go(1);
$('play').onclick = () => play(!state.playing);
$('step').max = finished;
$('step').oninput = e => { play(false); show(+e.target.value); };
$('lamp').onclick = () => lamp(!state.lamp);
$('explode').oninput = e => explode(+e.target.value);
$('hide').onclick = hide;
$('isolate').onclick = isolate;
$('all').onclick = showAll;
$('home').onclick = home;
const keys = {
  ArrowRight: e => e.shiftKey ? turnBy(-.15, 0) : go(1), ArrowLeft: e => e.shiftKey ? turnBy(.15, 0) : go(-1),
  ArrowUp: () => turnBy(0, .12), ArrowDown: () => turnBy(0, -.12), Home: () => $('first').click(), End: () => $('last').click(),
  ' ': () => play(!state.playing), '+': () => zoomBy(.85), '=': () => zoomBy(.85), '-': () => zoomBy(1.18), l: () => lamp(!state.lamp),
  e: () => explode(state.explode ? 0 : .6), h: hide, i: isolate, a: showAll, Escape: showAll, 0: home,
};
addEventListener('keydown', e => {
  const inControl = /^(INPUT|BUTTON)$/.test(e.target.tagName);
  const key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
  if (e.ctrlKey || e.metaKey || e.altKey || !keys[key] || (inControl && /^(Arrow|Home|End| )/.test(key))) return;
  e.preventDefault();
  keys[key](e);
});
const linked = () => { const m = /step=(\d+)/.exec(location.hash); return m ? +m[1] : finished; };
addEventListener('hashchange', () => { play(false); show(linked(), true); });
addEventListener('resize', redraw);
canvas.addEventListener('webglcontextlost', () => { $('fallback').hidden = false; });
$('summary').textContent = `${head.final} elements, ${facing.subarray(0, head.final).reduce((a, b) => a + (b ? 1 : 0), 0)} flipped, ${(head.size_mm / 10).toFixed(0)} cm`;
// @GHOST@
lamp(state.lamp);
show(linked(), true);
window.rhombloom = { state, pick, choose, show, camera, active, visible };
})();
