// The mesh of report.html, to turn and to look at: WebGL 2 and nothing else.
"use strict";

const VERTEX = `#version 300 es
  in vec3 position, normal;
  in vec2 uv; in float pixels;
  uniform vec3 right, above, back, eye; uniform vec2 depth;
  out vec3 n; out vec2 at; out float known;
  void main() {
    n = normal, at = uv, known = pixels > 0.0 ? 1.0 : 0.0;
    vec3 seen = (position - eye) * mat3(right, above, back);
    gl_Position = vec4(2.7474774 * seen.xy, depth.x * seen.z + depth.y, -seen.z);
  }`;

// Light: nine numbers for each colour, as lab 16's eq. (1) and (3).
const FRAGMENT = `#version 300 es
  precision highp float;
  in vec3 n; in vec2 at; in float known;
  uniform sampler2D albedo;
  uniform vec3 light[9], back; uniform int kind;
  out vec4 colour;
  void main() {
    vec3 d = normalize(n), linear = texture(albedo, at).rgb;
    if (kind == 0) linear *= 0.2820948 * light[0]
      + 0.4886025 * (d.y * light[1] + d.z * light[2] + d.x * light[3])
      + 1.0925484 * (d.x * d.y * light[4] + d.y * d.z * light[5] + d.x * d.z * light[7])
      + 0.3153916 * (3.0 * d.z * d.z - 1.0) * light[6]
      + 0.5462742 * (d.x * d.x - d.y * d.y) * light[8];
    if (kind >= 2) linear = vec3(0.75) * (0.15 + 0.85 * max(dot(d, back), 0.0));
    if (kind == 3) linear *= mix(vec3(1.0, 0.25, 0.0), vec3(1.0), known);
    linear = clamp(linear, 0.0, 1.0);
    vec3 low = 12.92 * linear, high = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    colour = vec4(mix(high, low, lessThan(linear, vec3(0.0031308))), 1.0);
  }`;

// --- the file -----------------------------------------------------------------------------------

function readGlb(uri) {
  const bytes = Uint8Array.from(atob(uri.slice(uri.indexOf(",") + 1)), c => c.charCodeAt(0));
  const length = new DataView(bytes.buffer).getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const part = view => {
    const { byteOffset = 0, byteLength } = gltf.bufferViews[view];
    return bytes.slice(28 + length + byteOffset, 28 + length + byteOffset + byteLength);
  };
  const array = index => part(gltf.accessors[index].bufferView).buffer;
  const { attributes, indices } = gltf.meshes[0].primitives[0];
  return { position: array(attributes.POSITION), normal: array(attributes.NORMAL),
    uv: array(attributes.TEXCOORD_0), pixels: array(attributes._PIXELS), index: new Uint32Array(array(indices)),
    image: new Blob([part(gltf.images[0].bufferView)], { type: "image/png" }) };
}

// --- vectors ------------------------------------------------------------------------------------

const cross = (a, b) => [1, 2, 0].map((i, k) => a[i] * b[(i + 1) % 3] - a[(i + 1) % 3] * b[i]);
const unit = a => a.map(x => x / Math.hypot(...a));
const sum = (...terms) => [0, 1, 2].map(i => terms.reduce((s, [f, v]) => s + f * v[i], 0));

// --- drawing ------------------------------------------------------------------------------------

function program(gl, made = gl.createProgram()) {
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text), gl.compileShader(shader), gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw Error(gl.getProgramInfoLog(made));
  gl.useProgram(made);
  return made;
}

function upload(gl, shaders, mesh, picture) {
  for (const [name, size] of [["position", 3], ["normal", 3], ["uv", 2], ["pixels", 1]]) {
    const place = gl.getAttribLocation(shaders, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, mesh[name], gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.index, gl.STATIC_DRAW);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, picture);
  gl.generateMipmap(gl.TEXTURE_2D);
  [gl.DEPTH_TEST, gl.CULL_FACE].forEach(test => gl.enable(test));
}

// The grid is the world, moved and scaled but not turned: normals, light and up are those of both.
function painter(gl, canvas, mesh, { light, up, centre, reach }, state) {
  const shaders = gl.getParameter(gl.CURRENT_PROGRAM);
  const at = name => gl.getUniformLocation(shaders, name);
  const side = unit(cross(up, Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
  const ahead = cross(side, up);
  gl.uniform3fv(at("light"), light.flat());
  return () => {
    const size = Math.round(canvas.clientWidth * Math.min(devicePixelRatio, 2));
    if (canvas.width !== size) canvas.width = canvas.height = size;
    gl.viewport(0, 0, size, size);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const flat = Math.cos(state.tilt), back = sum([flat * Math.cos(state.turn), ahead],
      [flat * Math.sin(state.turn), side], [Math.sin(state.tilt), up]);
    const right = unit(cross(up, back)), away = 3 * reach * state.away;
    const eye = sum([1, centre], [away, back]), axes = { right, above: cross(back, right), back };
    Object.entries({ ...axes, eye }).forEach(([name, v]) => gl.uniform3fv(at(name), v));
    const near = Math.max(away - 2 * reach, 0.02 * reach), far = away + 2 * reach;
    gl.uniform2f(at("depth"), (far + near) / (near - far), 2 * far * near / (near - far));
    gl.uniform1i(at("kind"), state.kind);
    gl.drawElements(gl.TRIANGLES, mesh.index.length, gl.UNSIGNED_INT, 0);
  };
}

const START = { turn: 0.8, tilt: 0.35, away: 1 };  // away: in distances that show the whole

// --- hands on it --------------------------------------------------------------------------------

function listen(canvas, state, draw) {
  const moved = (turn, tilt, nearer) => {
    state.turn += turn;
    state.tilt = Math.min(1.5, Math.max(-1.5, state.tilt + tilt));
    state.away = Math.min(3, Math.max(0.37, state.away * nearer));
    requestAnimationFrame(draw);
  };
  const fingers = new Map(), gap = ([a, b] = fingers.values()) => Math.hypot(a.x - b.x, a.y - b.y);
  canvas.onpointerdown = e => {
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, { x: e.clientX, y: e.clientY }); };
  canvas.onpointerup = canvas.onpointercancel = e => fingers.delete(e.pointerId);
  canvas.onpointermove = e => {
    const last = fingers.get(e.pointerId);
    if (!last) return;
    const before = fingers.size === 2 ? gap() : 0, now = { x: e.clientX, y: e.clientY };
    fingers.set(e.pointerId, now);
    if (before) moved(0, 0, before / Math.max(gap(), 1));
    else moved((last.x - now.x) * 0.01, (now.y - last.y) * 0.01, 1);
  };
  canvas.addEventListener("wheel", e => {
    if (document.activeElement !== canvas) return;
    e.preventDefault();
    moved(0, 0, Math.exp(0.001 * e.deltaY));
  }, { passive: false });
  canvas.onkeydown = e => {
    const moves = { ArrowLeft: [-0.15, 0, 1], ArrowRight: [0.15, 0, 1], ArrowUp: [0, 0.15, 1],
      ArrowDown: [0, -0.15, 1], "+": [0, 0, 0.9], "=": [0, 0, 0.9], "-": [0, 0, 1 / 0.9] };
    if (e.key === "0") Object.assign(state, START);
    if (!moves[e.key] && e.key !== "0") return;
    e.preventDefault();
    moved(...(moves[e.key] || [0, 0, 1]));
  };
  new ResizeObserver(draw).observe(canvas);
}

function offerLights(state, draw) {
  const bar = document.getElementById("lights");
  const buttons = ["In the light found", "Colours only", "Clay", "Unseen"].map((name, kind) => {
    const button = Object.assign(document.createElement("button"), { textContent: name });
    button.onclick = () => {
      state.kind = kind;
      buttons.forEach((each, k) => { each.ariaPressed = k === kind; });
      draw(); };
    button.ariaPressed = kind === 0;
    return bar.appendChild(button);
  });
  bar.hidden = document.getElementById("help").hidden = false;
}

async function begin() {
  const text = id => document.getElementById(id).textContent;
  const canvas = document.createElement("canvas"), gl = canvas.getContext("webgl2");
  if (!gl) return;  // the animation stays
  const mesh = readGlb(text("mesh")), state = { ...START, kind: 0 };
  const picture = await createImageBitmap(mesh.image);
  upload(gl, program(gl), mesh, picture);
  const draw = painter(gl, canvas, mesh, JSON.parse(text("scene")), state);
  Object.assign(canvas, { tabIndex: 0, role: "img", ariaLabel: "The object. Arrow keys turn it." });
  document.querySelector("#orbit img").replaceWith(canvas);
  listen(canvas, state, draw);
  offerLights(state, draw);
}

begin();
