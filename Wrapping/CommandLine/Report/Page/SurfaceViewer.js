// Shows the model of the page: drag to turn it, wheel or pinch to come nearer, drag with the right
// button, shift or two fingers to move it. No library: WebGL 2 only.
(function () {
  "use strict";
  const canvas = document.getElementById("view");
  const model = JSON.parse(document.getElementById("model-data").textContent);
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) {
    giveUp();
    return;
  }

  function giveUp() {
    canvas.hidden = true;
    canvas.style.display = "none";
    document.querySelector("#viewer .buttons").hidden = true;
    document.querySelector("#viewer .buttons").style.display = "none";
    document.getElementById("viewer-missing").hidden = false;
  }

  // --- The data: little-endian arrays in base64 ------------------------------------------------

  function decode(text, Type) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Type(bytes.buffer);
  }

  // --- Vectors of three, and 4 x 4 matrices column by column -----------------------------------

  const add = (a, b) => a.map((x, i) => x + b[i]);
  const subtract = (a, b) => a.map((x, i) => x - b[i]);
  const scale = (a, s) => a.map((x) => x * s);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const length = (a) => Math.hypot(a[0], a[1], a[2]);
  const normalize = (a) => scale(a, 1 / (length(a) || 1));

  function multiply(a, b) {
    const product = new Float32Array(16);
    for (let column = 0; column < 4; ++column) {
      for (let row = 0; row < 4; ++row) {
        for (let k = 0; k < 4; ++k) {
          product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
        }
      }
    }
    return product;
  }

  // --- The viewpoint: an orbit around a target, upright ----------------------------------------

  const up = normalize(model.up);
  const front = normalize(cross(up, Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
  const side = cross(up, front);
  let orbit;

  function resetOrbit() {
    const from = subtract(model.position, model.target);
    const distance = length(from);
    orbit = {
      target: model.target.slice(),
      distance,
      elevation: Math.asin(Math.max(-1, Math.min(1, dot(from, up) / distance))),
      azimuth: Math.atan2(dot(from, side), dot(from, front)),
    };
  }

  function frameOfOrbit() {
    const level = add(scale(front, Math.cos(orbit.azimuth)), scale(side, Math.sin(orbit.azimuth)));
    const back = add(scale(level, Math.cos(orbit.elevation)), scale(up, Math.sin(orbit.elevation)));
    const right = normalize(cross(up, back));
    return { back, right, above: cross(back, right), eye: add(orbit.target, scale(back, orbit.distance)) };
  }

  function viewMatrix({ right, above, back, eye }) {
    return new Float32Array([
      right[0], above[0], back[0], 0, right[1], above[1], back[1], 0, right[2], above[2], back[2], 0,
      -dot(right, eye), -dot(above, eye), -dot(back, eye), 1]);
  }

  function projectionMatrix(aspect, near, far) {
    // The field of view of the shorter side stays, so that a narrow window shows the whole, too.
    const tangent = model.tangent * (aspect < 1.3 ? 1.3 / aspect : 1);
    return new Float32Array([
      1 / (tangent * aspect), 0, 0, 0, 0, 1 / tangent, 0, 0,
      0, 0, (near + far) / (near - far), -1, 0, 0, 2 * near * far / (near - far), 0]);
  }

  function turn(right, down) {
    const limit = Math.PI / 2 - 0.02;
    orbit.azimuth -= right;
    orbit.elevation = Math.max(-limit, Math.min(limit, orbit.elevation + down));
    draw();
  }

  function move(right, down) {
    const frame = frameOfOrbit();
    const step = 2 * orbit.distance * model.tangent / canvas.clientHeight;
    orbit.target = add(orbit.target, add(scale(frame.right, -right * step), scale(frame.above, down * step)));
    draw();
  }

  function approach(factor) {
    orbit.distance = Math.max(0.02 * model.radius, Math.min(30 * model.radius, orbit.distance * factor));
    draw();
  }

  // --- What is drawn ----------------------------------------------------------------------------

  const surfaceVertex = `#version 300 es
    in vec3 position; in vec2 texel; uniform mat4 view; uniform mat4 projection; uniform vec3 origin; uniform vec3 size;
    out vec2 at; out vec3 seen;
    void main() {
      vec4 p = view * vec4(origin + position * size, 1.0);
      at = texel; seen = p.xyz; gl_Position = projection * p;
    }`;
  const surfaceFragment = `#version 300 es
    precision highp float; in vec2 at; in vec3 seen; uniform sampler2D colors; uniform bool textured; out vec4 color;
    void main() {
      vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
      float light = 0.30 + 0.34 * max(0.0, dot(normal, normalize(vec3(-0.45, 0.65, 0.6))))
        + 0.36 * max(0.0, dot(normal, normalize(-seen)));
      color = textured ? vec4(texture(colors, at).rgb, 1.0) : vec4(vec3(0.90, 0.93, 0.96) * light, 1.0);
    }`;
  const paintVertex = `#version 300 es
    in vec3 position; in vec4 paint; uniform mat4 view; uniform mat4 projection; uniform vec3 origin; uniform vec3 size;
    uniform float pointSize; out vec4 painted;
    void main() {
      vec4 p = view * vec4(origin + position * size, 1.0);
      painted = paint; gl_PointSize = pointSize; gl_Position = projection * p;
      gl_Position.z -= 0.0005 * gl_Position.w;
    }`;
  const paintFragment = `#version 300 es
    precision highp float; in vec4 painted; out vec4 color; void main() { color = painted; }`;

  function makeProgram(vertex, fragment, names) {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    names.forEach((name, i) => gl.bindAttribLocation(program, i, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error("The model's shader does not link: " + gl.getProgramInfoLog(program));
    }
    return { program, at: (name) => gl.getUniformLocation(program, name) };
  }

  function makeArrays(attributes, indices) {
    const arrays = gl.createVertexArray();
    gl.bindVertexArray(arrays);
    attributes.forEach(({ values, components, type, normalized }, i) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, components, type, normalized, 0, 0);
    });
    if (indices) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    }
    gl.bindVertexArray(null);
    return arrays;
  }

  const surface = makeProgram(surfaceVertex, surfaceFragment, ["position", "texel"]);
  const paint = makeProgram(paintVertex, paintFragment, ["position", "paint"]);
  const triangles = decode(model.triangles, Uint32Array);
  const surfaceArrays = makeArrays([
    { values: decode(model.points, Uint16Array), components: 3, type: gl.UNSIGNED_SHORT, normalized: true },
    { values: decode(model.texels, Uint16Array), components: 2, type: gl.UNSIGNED_SHORT, normalized: true },
  ], triangles);
  const features = decode(model.features, Uint16Array);
  const featureArrays = makeArrays([
    { values: features, components: 3, type: gl.UNSIGNED_SHORT, normalized: true },
    { values: decode(model.featureColors, Uint8Array), components: 3, type: gl.UNSIGNED_BYTE, normalized: true },
  ]);
  const cameraLines = new Float32Array(model.cameras);
  const cameraArrays = makeArrays([
    { values: cameraLines, components: 3, type: gl.FLOAT, normalized: false },
    { values: new Uint8Array(model.cameraColors), components: 3, type: gl.UNSIGNED_BYTE, normalized: true },
  ]);
  const colors = gl.createTexture();
  const shown = { textured: true, points: false, cameras: false };
  let hasTexture = false;

  const photograph = new Image();
  photograph.onload = function () {
    gl.bindTexture(gl.TEXTURE_2D, colors);
    gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, gl.RGB, gl.UNSIGNED_BYTE, photograph);
    gl.generateMipmap(gl.TEXTURE_2D);
    // Charts lie close beside each other: coarser levels would mix them.
    gl.texParameterf(gl.TEXTURE_2D, gl.TEXTURE_MAX_LOD, 1.5);
    hasTexture = true;
    canvas.dataset.ready = "true";
    draw();
  };

  function useCamera(program, view, projection, origin, size) {
    gl.useProgram(program.program);
    gl.uniformMatrix4fv(program.at("view"), false, view);
    gl.uniformMatrix4fv(program.at("projection"), false, projection);
    gl.uniform3fv(program.at("origin"), origin);
    gl.uniform3fv(program.at("size"), size);
  }

  function drawNow() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const frame = frameOfOrbit();
    const reach = length(subtract(frame.eye, model.middle)) + 3 * model.radius;
    const view = viewMatrix(frame);
    const projection = projectionMatrix(width / height, Math.max(reach / 4000, orbit.distance / 100), reach);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    useCamera(surface, view, projection, model.origin, model.size);
    gl.uniform1i(surface.at("textured"), shown.textured && hasTexture ? 1 : 0);
    gl.bindTexture(gl.TEXTURE_2D, colors);
    gl.bindVertexArray(surfaceArrays);
    gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0);
    if (shown.points) {
      useCamera(paint, view, projection, model.origin, model.size);
      gl.uniform1f(paint.at("pointSize"), 2 * ratio);
      gl.bindVertexArray(featureArrays);
      gl.drawArrays(gl.POINTS, 0, features.length / 3);
    }
    if (shown.cameras) {
      useCamera(paint, view, projection, [0, 0, 0], [1, 1, 1]);
      gl.uniform1f(paint.at("pointSize"), 1);
      gl.bindVertexArray(cameraArrays);
      gl.drawArrays(gl.LINES, 0, cameraLines.length / 3);
    }
    gl.bindVertexArray(null);
  }

  let waiting = false;
  function draw() {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(() => { waiting = false; drawNow(); });
    }
  }

  // --- Mouse, fingers, keys and buttons -----------------------------------------------------------

  const pointers = new Map();
  const spread = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    const now = { x: event.clientX, y: event.clientY };
    const right = now.x - before.x;
    const down = now.y - before.y;
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      approach(spread(before, other) / Math.max(spread(now, other), 1));
      move(right / 2, down / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      move(right, down);
    } else {
      turn(right * 0.008, down * 0.008);
    }
    pointers.set(event.pointerId, now);
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    approach(Math.exp(Math.max(-60, Math.min(60, event.deltaY * lines)) * 0.002));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const keys = {
      ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0),
      ArrowUp: () => turn(0, -0.1), ArrowDown: () => turn(0, 0.1),
      "+": () => approach(0.9), "=": () => approach(0.9), "-": () => approach(1 / 0.9),
    };
    if (keys[event.key]) {
      event.preventDefault();
      keys[event.key]();
    }
  });
  for (const button of document.querySelectorAll("#viewer button")) {
    button.addEventListener("click", () => {
      const what = button.dataset.show;
      if (what === "reset") {
        resetOrbit();
      } else {
        shown[what] = !shown[what];
        button.setAttribute("aria-pressed", String(shown[what]));
      }
      draw();
    });
  }
  canvas.addEventListener("webglcontextlost", giveUp);
  new ResizeObserver(draw).observe(canvas);
  resetOrbit();
  photograph.src = model.texture;
  draw();
})();
