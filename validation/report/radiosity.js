// SPDX-License-Identifier: Apache-2.0
// A solved room to walk through, by WebGL. Without it the drawing stays that the page has without a script.

const VERTEX_SHADER = "attribute vec3 place; attribute vec3 light; uniform mat4 view; varying vec3 shown;" +
  "void main() { shown = light; gl_Position = view * vec4(place, 1.0); }";
const FRAGMENT_SHADER = "precision highp float; varying vec3 shown; uniform float gain; uniform float decades; uniform vec3 ramp[5];" +
  "vec3 encoded(vec3 v) { v = clamp(v, 0.0, 1.0);" +
  " return mix(12.92 * v, 1.055 * pow(max(v, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v)); }" +
  "vec3 ramped(float share) { float at = clamp(share, 0.0, 1.0) * 4.0; vec3 c = ramp[0];" +
  " for (int i = 0; i < 4; ++i) c = mix(c, ramp[i + 1], clamp(at - float(i), 0.0, 1.0)); return c; }" +
  "void main() { float y = dot(shown, vec3(0.2126, 0.7152, 0.0722)) * gain;" +
  " gl_FragColor = vec4(decades > 0.0 ? ramped(1.0 + log(max(y, 1e-9)) / log(10.0) / decades) : encoded(shown * gain), 1.0); }";
const FALSE_COLOUR_DECADES = 3;

function linkedProgram(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX_SHADER], [gl.FRAGMENT_SHADER, FRAGMENT_SHADER]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
}

// Each element as a fan of triangles: x, y, z, red, green, blue of each corner.
function trianglesOf(f) {
  const corners = listOf(f, "f64_corners"), light = listOf(f, "f64_radiosity"), list = [];
  let first = 0;
  f.sizes.forEach(function (size, element) {
    for (let k = 1; k + 1 < size; ++k)
      for (const c of [first, first + k, first + k + 1])
        list.push(corners[3 * c], corners[3 * c + 1], corners[3 * c + 2], light[3 * element], light[3 * element + 1], light[3 * element + 2]);
    first += size;
  });
  return new Float32Array(list);
}

function crossed(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
function dotted(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// What takes a place to the screen, column by column; z is up.
function viewMatrix(eye, yaw, pitch, aspect) {
  const gaze = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
  const x = [Math.sin(yaw), -Math.cos(yaw), 0], y = crossed(x, gaze), near = 0.05, far = 100, zoom = 1.9;
  const depth = (far + near) / (far - near), row = function (v, scale) { return v.map(function (c) { return c * scale; }).concat(-scale * dotted(v, eye)); };
  const rows = [row(x, zoom / aspect), row(y, zoom), row(gaze, depth), row(gaze, 1)];
  rows[2][3] -= 2 * far * near / (far - near);
  return new Float32Array([0, 1, 2, 3].flatMap(function (c) { return rows.map(function (r) { return r[c]; }); }));
}

function prepared(gl, program, f) {
  const triangles = trianglesOf(f);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  gl.useProgram(program);
  ["place", "light"].forEach(function (name, k) {
    const at = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 24, 12 * k);
  });
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.CULL_FACE);
  gl.uniform3fv(gl.getUniformLocation(program, "ramp"), RAMP.flat().map(function (c) { return c / 255; }));
  return triangles.length / 6;
}

function drawRadiosity(f, article) {
  const stage = article.querySelector(".stage"), canvas = document.createElement("canvas");
  canvas.width = 960;
  canvas.height = 720;
  const gl = canvas.getContext("webgl", { preserveDrawingBuffer: true }), program = gl && linkedProgram(gl);
  if (!program) return null;
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", "The solved room; arrow keys turn, W and S go, drag turns");
  canvas.className = "room";
  const tools = makeTools(stage), still = stage.querySelector("svg");
  still.classList.add("printed");
  stage.append(canvas);
  const exposure = makeSlider(tools, "Exposure, in stops", -8, 8, 0), colour = makeSelect(tools, "Colour", ["as seen", "false colour"]);
  const count = prepared(gl, program, f), uniform = function (name) { return gl.getUniformLocation(program, name); };
  const middle = f.sum / (3 * f.sizes.length), base = 0.4 / middle;
  const place = { eye: f.eye.slice(), yaw: Math.atan2(f.gaze[1], f.gaze[0]), pitch: Math.asin(f.gaze[2]) };
  const show = function () {
    gl.clearColor(0, 0, 0, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(uniform("view"), false, viewMatrix(place.eye, place.yaw, place.pitch, canvas.width / canvas.height));
    gl.uniform1f(uniform("gain"), base * Math.pow(2, Number(exposure.value)));
    gl.uniform1f(uniform("decades"), colour.value === "false colour" ? FALSE_COLOUR_DECADES : 0);
    gl.drawArrays(gl.TRIANGLES, 0, count);
  };
  const turn = function (yaw, pitch) {
    place.yaw += yaw;
    place.pitch = Math.max(-1.5, Math.min(1.5, place.pitch + pitch));
    show();
  };
  canvas.addEventListener("keydown", function (event) {
    const turned = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    const gone = { w: 0.25, s: -0.25 }[event.key.toLowerCase()];
    if (!turned && !gone) return;
    event.preventDefault();
    if (gone) place.eye = [place.eye[0] + gone * Math.cos(place.yaw), place.eye[1] + gone * Math.sin(place.yaw), place.eye[2]];
    turn(...(turned || [0, 0]));
  });
  canvas.addEventListener("pointermove", function (event) { if (event.buttons & 1) turn(event.movementX * 0.005, event.movementY * 0.005); });
  exposure.addEventListener("input", show);
  colour.addEventListener("change", show);
  show();
  return { canvas: canvas, gl: gl, place: place, base: base, exposure: exposure, show: show };
}
