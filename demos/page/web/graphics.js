// Draws a moment by WebGL 2: sun with soft shadows, light from sky and ground, ground checker, air, water. The look is
// the renderer's (renderer/draw): the same light, film and geometry. Frame E has its origin at the eye.

import { channels, linearLight, sub } from "./geometry.js";
import { linked } from "./program.js";
import { DAYLIGHT, checkerSquare, fitShadow, nearDepth } from "./sunlight.js";
import { Water } from "./water.js";

const SHADOW_TEXELS = 2048, SHADOW_LIFT = 2.6, GROUND_RINGS = 3, FRAME_FLOATS = 84;
const STILL_FLOATS = 7, MOVING_FLOATS = 11;
const OUTLINE_PX = 2.5;

export class Graphics {
  constructor(canvas, recording) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL 2");
    Object.assign(this, { canvas, gl, recording, light: { ...DAYLIGHT, ...recording.facts.light } });
    this.ground = recording.facts.ground ?? null;
    this.bodies = recording.bodies.map((body, i) => ({ ...body, index: i, endless: this.ground?.body === i }));
    this.makePrograms();
    this.makeBuffers();
    this.makeShadowMap();
    this.water = recording.facts.water.length > 0 ? new Water(gl, recording.facts.water) : null;
  }

  makePrograms() {
    const { gl } = this, inner = this.recording.facts.water.length > 0 ? ["LINEAR"] : [];
    this.programs = {
      body: linked(gl, "body.vert", "body.frag", inner),
      shadow: linked(gl, "body.vert", "body.frag", ["SHADOW"]),
      id: linked(gl, "body.vert", "body.frag", ["ID"]),
      outline: linked(gl, "body.vert", "body.frag", ["OUTLINE", ...inner]),
      ground: linked(gl, "ground.vert", "ground.frag", inner),
      nearby: linked(gl, "nearby.vert", "nearby.frag", inner),
      sky: linked(gl, "sky.vert", "sky.frag", inner),
    };
    this.frame = new Float32Array(FRAME_FLOATS);
    this.frameBuffer = gl.createBuffer();
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.frameBuffer);
    gl.bufferData(gl.UNIFORM_BUFFER, this.frame.byteLength, gl.DYNAMIC_DRAW);
    this.nothing = gl.createVertexArray();
  }

  /** Bodies in the order of their meshes: one draw call a mesh. */
  makeBuffers() {
    const { gl } = this;
    this.drawn = this.bodies.filter(body => !body.endless).sort((a, b) => a.mesh - b.mesh || a.index - b.index);
    const still = new Float32Array(STILL_FLOATS * this.drawn.length);
    this.drawn.forEach((body, i) => {
      const size = sub(body.high, body.low);
      const stands = body.boxy && !body.checker ? 0.25 : 0;
      still.set([...body.low, ...size, body.index + stands], STILL_FLOATS * i);
      body.darkened = (body.checker ? -0.35 : 0.35) * Math.min(...size);
      body.own = channels(body.color).map(linearLight);
    });
    this.still = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.still);
    gl.bufferData(gl.ARRAY_BUFFER, still, gl.STATIC_DRAW);
    this.moving = gl.createBuffer();
    this.rows = new Float32Array(MOVING_FLOATS * this.drawn.length);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.moving);
    gl.bufferData(gl.ARRAY_BUFFER, this.rows.byteLength, gl.DYNAMIC_DRAW);
    this.groups = [];
    for (let first = 0, end = 0; first < this.drawn.length; first = end) {
      const number = this.drawn[first].mesh;
      while (end < this.drawn.length && this.drawn[end].mesh === number) ++end;
      this.groups.push(this.meshGroup(this.recording.meshes[number], first, end - first));
    }
    this.all = this.vertexArray(0);
  }

  /** A vertex array whose instances begin with the body `first` of those drawn. */
  vertexArray(first) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const instances = (buffer, floats, parts) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      let at = 4 * floats * first;
      for (const [location, count] of parts) {
        gl.enableVertexAttribArray(location);
        gl.vertexAttribPointer(location, count, gl.FLOAT, false, 4 * floats, at);
        gl.vertexAttribDivisor(location, 1);
        at += 4 * count;
      }
    };
    instances(this.still, STILL_FLOATS, [[3, 3], [4, 3], [8, 1]]);
    instances(this.moving, MOVING_FLOATS, [[5, 3], [6, 4], [7, 4]]);
    return array;
  }

  meshGroup(mesh, first, count) {
    const { gl } = this, array = this.vertexArray(first);
    const attribute = (location, data, size, kind) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, kind, true, 0, 0);
    };
    attribute(0, mesh.positions, 4, gl.UNSIGNED_SHORT);
    attribute(1, mesh.normals, 2, gl.SHORT);
    attribute(2, mesh.tints, 4, gl.UNSIGNED_BYTE);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    const indices = mesh.vertices < 65536 ? new Uint16Array(mesh.indices) : mesh.indices;
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    const kind = mesh.vertices < 65536 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
    return { array, first, count, indices: mesh.indices.length, kind };
  }

  makeShadowMap() {
    const { gl } = this;
    this.map = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_TEXELS, SHADOW_TEXELS);
    for (const [name, value] of [[gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE],
                                 [gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL], [gl.TEXTURE_MIN_FILTER, gl.LINEAR],
                                 [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
                                 [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, name, value);
    this.shadowTarget = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.map, 0);
    gl.drawBuffers([gl.NONE]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** Where the bodies are and how they look. `colors` gives a body's colour, or null for its own. */
  placeBodies(view, colors) {
    const { positions, rotations } = this.recording, [ex, ey, ez] = view.eye;
    this.drawn.forEach((body, i) => {
      const at = MOVING_FLOATS * i, p = 3 * body.index, q = 4 * body.index, color = colors?.(body.index) ?? body.own;
      this.rows[at] = positions[p] - ex;
      this.rows[at + 1] = positions[p + 1] - ey;
      this.rows[at + 2] = positions[p + 2] - ez;
      for (let k = 0; k < 4; ++k) this.rows[at + 3 + k] = rotations[q + k];
      for (let k = 0; k < 3; ++k) this.rows[at + 7 + k] = color[k];
      this.rows[at + 10] = body.darkened;
    });
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.moving);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, this.rows);
  }

  placeFrame(view) {
    const { gl, frame, light } = this, { right, up, forward, focal, width, height, distance, eye } = view;
    const near = nearDepth(view, this.recording.positions, this.bodies, this.ground ? this.ground.z - eye[2] : null);
    const far = 4000 * distance, w = 2 * focal / width, h = 2 * focal / height;
    const deep = (far + near) / (far - near);
    for (let c = 0; c < 3; ++c) frame.set([w * right[c], h * up[c], deep * forward[c], forward[c]], 4 * c);
    frame.set([0, 0, -2 * far * near / (far - near), 0], 12);
    const casters = this.drawn.map((body, i) =>
      ({ center_E: Array.from(this.rows.subarray(MOVING_FLOATS * i, MOVING_FLOATS * i + 3)), radius: body.radius }));
    const shadow = fitShadow(view, light.toSun, casters, SHADOW_TEXELS);
    const rows = shadow?.rows ?? [[0, 0, 0, -1], [0, 0, 0, -1], [0, 0, 0, 0]];
    rows.forEach((row, i) => frame.set(row, 16 + 4 * i));
    const length = Math.hypot(...light.toSun);
    frame.set([...light.toSun.map(x => x / length), SHADOW_LIFT * (shadow?.texel ?? 0)], 28);
    for (let c = 0; c < 3; ++c) {
      frame[32 + c] = forward[c] - 0.5 * (width * right[c] + height * up[c]) / focal;
      frame[36 + c] = right[c] / focal;
      frame[40 + c] = up[c] / focal;
    }
    frame[35] = 1 / (6 * distance);
    frame[39] = SHADOW_TEXELS;
    frame[43] = this.ground ? 1 : 0;
    const square = checkerSquare(distance);
    frame.set([this.ground ? this.ground.z - eye[2] : -1e30, 1 / square, (eye[0] / square) % 2, (eye[1] / square) % 2], 44);
    frame.set([2000 * distance / (1 << (4 * GROUND_RINGS)), OUTLINE_PX * (globalThis.devicePixelRatio ?? 1), near, far], 48);
    ["sun", "skyLight", "groundLight", "horizon", "zenith", "below", "lightSquare", "darkSquare"].forEach(
      (name, i) => frame.set(light[name], 52 + 4 * i));
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frameBuffer);
    gl.bufferSubData(gl.UNIFORM_BUFFER, 0, frame);
    return shadow !== null;
  }

  drawGroups(program) {
    const { gl } = this;
    gl.useProgram(program);
    for (const { array, count, indices, kind } of this.groups) {
      gl.bindVertexArray(array);
      gl.drawElementsInstanced(gl.TRIANGLES, indices, kind, 0, count);
    }
  }

  drawShadows() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.viewport(0, 0, SHADOW_TEXELS, SHADOW_TEXELS);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.drawGroups(this.programs.shadow);
  }

  drawScene(view, selected) {
    const { gl, programs } = this;
    gl.viewport(0, 0, view.width, view.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawGroups(programs.body);
    if (selected !== null) this.drawOutline(selected);
    gl.bindVertexArray(this.nothing);
    if (this.ground && view.eye[2] > this.ground.z) {
      gl.useProgram(programs.ground);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4 + 10 * GROUND_RINGS);
      this.drawNearby();
    }
    gl.bindVertexArray(this.nothing);
    gl.useProgram(programs.sky);
    gl.depthMask(false);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.depthMask(true);
  }

  /** Less light of the sky on the ground near bodies. */
  drawNearby() {
    const { gl } = this;
    gl.useProgram(this.programs.nearby);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.DST_COLOR, gl.ZERO);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(-1, -2);
    gl.depthMask(false);
    gl.bindVertexArray(this.all);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.drawn.length);
    gl.depthMask(true);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.disable(gl.BLEND);
  }

  /** A body once more, a little thicker, seen from inside: what stands out is its outline. */
  drawOutline(selected) {
    const { gl } = this, place = this.drawn.findIndex(body => body.index === selected);
    if (place < 0) return;
    this.outlines ??= new Map();
    if (!this.outlines.has(place))
      this.outlines.set(place, this.meshGroup(this.recording.meshes[this.drawn[place].mesh], place, 1));
    const { array, indices, kind } = this.outlines.get(place);
    gl.useProgram(this.programs.outline);
    gl.enable(gl.CULL_FACE);
    gl.cullFace(gl.FRONT);
    gl.bindVertexArray(array);
    gl.drawElementsInstanced(gl.TRIANGLES, indices, kind, 0, 1);
    gl.disable(gl.CULL_FACE);
  }

  /** `moment`: time, colors, selected. */
  draw(view, moment) {
    const { gl } = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    this.placeBodies(view, moment.colors);
    if (this.placeFrame(view)) this.drawShadows();
    if (this.water) {
      this.water.begin(view);
      this.drawScene(view, moment.selected);
      this.water.finish(view, moment.time, { near: this.frame[50], far: this.frame[51] });
    } else {
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      this.drawScene(view, moment.selected);
    }
  }

  /** The body at a pixel of the picture last drawn, from its upper left corner; null where there is none. */
  pick(view, x, y) {
    const { gl } = this;
    this.picked ??= this.makePicked();
    const { target, color, depth } = this.picked;
    gl.bindTexture(gl.TEXTURE_2D, color);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, view.width, view.height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, view.width, view.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.enable(gl.SCISSOR_TEST);
    const row = view.height - 1 - Math.floor(y), column = Math.floor(x), pixel = new Uint8Array(4);
    gl.scissor(column, row, 1, 1);
    gl.viewport(0, 0, view.width, view.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawGroups(this.programs.id);
    gl.readPixels(column, row, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const id = pixel[0] + 256 * pixel[1] + 65536 * pixel[2];
    return id > 0 ? id - 1 : null;
  }

  makePicked() {
    const { gl } = this, target = gl.createFramebuffer(), color = gl.createTexture(), depth = gl.createRenderbuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.bindTexture(gl.TEXTURE_2D, color);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    return { target, color, depth };
  }
}
