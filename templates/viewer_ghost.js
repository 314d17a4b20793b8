// The target of an import, in the page only when there is one (exporters/preview_ghost.h). Runs inside viewer.js.
{
  const packed = Uint8Array.from(atob($('ghost').textContent.trim()), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const view = new DataView(await new Response(stream).arrayBuffer());
  const points = view.getUint32(0, true), corners = 3 * view.getUint32(4, true), step = view.getFloat32(20, true);
  let from = 24;
  const shorts = count => {
    const out = Int16Array.from({ length: count }, (_, i) => view.getUint8(from + i) | view.getUint8(from + count + i) << 8);
    from += 2 * count;
    return out;
  };
  const where = new Float32Array(3 * points), index = new Uint32Array(corners);
  for (let r = 0; r < 3; ++r) {
    let now = 0;
    shorts(points).forEach((d, i) => { now += d; where[3 * i + r] = view.getFloat32(8 + 4 * r, true) + now * step; });
  }
  let next = 0;
  shorts(corners).forEach((d, i) => { index[i] = next - d; next = Math.max(next, index[i] + 1); });

  const skin = gl.createProgram();
  gl.attachShader(skin, compile(gl.VERTEX_SHADER, `
layout(location=0) in vec3 point; uniform mat4 camera; out vec3 place;
void main() { place = point; gl_Position = camera * vec4(point, 1.); }`));
  gl.attachShader(skin, compile(gl.FRAGMENT_SHADER, `
in vec3 place; out vec4 color; uniform vec3 eye;
void main() {
  float rim = 1. - abs(dot(normalize(cross(dFdx(place), dFdy(place))), normalize(eye - place)));
  float alpha = mix(.2, .75, rim * rim);
  color = vec4(vec3(.3, .45, .7) * alpha, alpha);
}`));
  gl.linkProgram(skin);
  const lens = gl.getUniformLocation(skin, 'camera'), pupil = gl.getUniformLocation(skin, 'eye');
  const vao = gl.createVertexArray();
  gl.bindVertexArray(vao);
  attribute(0, where, 3);
  buffer(gl.ELEMENT_ARRAY_BUFFER, index);
  gl.bindVertexArray(null);
  state.ghost = false;
  afterwards = a => {
    if (!state.ghost) return;
    gl.useProgram(skin);
    gl.bindVertexArray(vao);
    gl.uniformMatrix4fv(lens, false, matrix(a));
    gl.uniform3fv(pupil, a.eye);
    gl.depthMask(false);
    gl.enable(gl.CULL_FACE);
    for (const side of [gl.FRONT, gl.BACK]) {
      gl.cullFace(side);
      gl.drawElements(gl.TRIANGLES, corners, gl.UNSIGNED_INT, 0);
    }
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
    gl.bindVertexArray(null);
    gl.useProgram(program);
  };
  const button = document.createElement('button');
  Object.assign(button, { id: 'target', title: 'T: the shape that the elements imitate', textContent: 'Target' });
  button.onclick = () => { state.ghost = !state.ghost; button.setAttribute('aria-pressed', String(state.ghost)); redraw(); };
  button.setAttribute('aria-pressed', 'false');
  $('lamp').after(button);
  keys.t = () => button.click();
}
