// Draws a moment by WebGL 2: sun with soft shadows, light from sky and ground, surfaces, grounds, air, water, glass. The
// shaders are the renderer's own (renderer/glsl), and so is the geometry. Frame E has its origin at the eye.

import { channels, dot, linearLight, sub } from "./geometry.js";
import { Offscreen } from "./offscreen.js";
import { uploadPictures } from "./pictures.js";
import { linked } from "./program.js";
import { checkerSquare, fitShadow, nearDepth } from "./sunlight.js";
import { Water } from "./water.js";

const SHADOW_TEXELS = 2048, SHADOW_LIFT = 2.2, GROUND_RINGS = 3, FRAME_FLOATS = 68;
const STILL_FLOATS = 11, MOVING_FLOATS = 11;
const OUTLINE_PX = 2.5, PATTERN_PERIOD = 64, GLASS = "glass", MOST_COPIES = 12;

export class Graphics {
  constructor(canvas, recording) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL 2");
    Object.assign(this, { canvas, gl, recording, light: recording.facts.light });
    this.ground = recording.facts.ground ?? null;
    this.bodies = recording.bodies.map((body, i) => ({ ...body, index: i, endless: this.ground?.body === i }));
    const { water } = recording.facts;
    this.isFinished = water.length === 0 && !this.bodies.some(({ look }) => look === GLASS);
    this.lines = this.light.lines + (this.isFinished ? "" : "#define LINEAR\n");
    this.makePrograms();
    this.makeBuffers();
    this.makeShadowMap();
    if (recording.pictures) uploadPictures(gl, recording.pictures);
    if (this.isFinished) return;
    this.offscreen = new Offscreen(gl);
    this.water = new Water(gl, water, this.light.lines);
  }

  makePrograms() {
    const { gl, lines } = this, plain = { lines, shades: false };
    const ground = this.ground ? lines + this.recording.facts.looks[this.bodies[this.ground.body].look] : lines;
    this.programs = {
      shadow: linked(gl, "body.vert", "shadow_fragment", { lines: "#define SHADOW\n", shades: false }),
      id: linked(gl, "body.vert", "mark.frag", { lines: "#define ID\n", shades: false }),
      outline: linked(gl, "body.vert", "mark.frag", { lines: lines + "#define OUTLINE\n", shades: false }),
      ground: linked(gl, "ground_vertex", ["ground_common", "ground_shadowed_fragment"], { lines: ground }),
      nearby: linked(gl, "nearby.vert", "occlusion_fragment", plain),
      sky: linked(gl, "sky_vertex", "sky_fragment", { lines }),
    };
    this.looks = new Map();
    this.frame = new Float32Array(FRAME_FLOATS);
    this.frameBuffer = gl.createBuffer();
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.frameBuffer);
    gl.bufferData(gl.UNIFORM_BUFFER, this.frame.byteLength, gl.DYNAMIC_DRAW);
    this.nothing = gl.createVertexArray();
  }

  /** The program of bodies of that look, of a mesh with places on pictures or without, and that of their shadows. */
  programsOf(look, pictured) {
    const name = pictured ? look + " with pictures" : look;
    if (!this.looks.has(name)) {
      const lines = this.lines + (pictured ? "#define PICTURES\n" : "") + (this.recording.facts.looks[look] ?? "");
      const { gl, programs } = this;
      this.looks.set(name, look === GLASS
        ? { body: linked(gl, "body.vert", "glass_fragment", { lines: "#define GLASS\n" + lines }),
            shadow: linked(gl, "body.vert", "shadow_fragment", { lines: "#define SHADOW\n#define GLASS\n", shades: false }) }
        : { body: linked(gl, "body.vert", "body_fragment", { lines }), shadow: programs.shadow });
    }
    return this.looks.get(name);
  }

  /** Bodies in the order of their meshes and looks: one draw call for all that have the same. */
  makeBuffers() {
    const { gl } = this;
    this.drawn = this.bodies.filter(body => !body.endless).sort((a, b) =>
      a.mesh - b.mesh || (a.look < b.look ? -1 : a.look > b.look ? 1 : a.index - b.index));
    const still = new Float32Array(STILL_FLOATS * this.drawn.length);
    this.drawn.forEach((body, i) => {
      const size = sub(body.high, body.low);
      const stands = body.boxy && !body.checker ? 0.25 : 0;
      still.set([...body.low, ...size, body.index + stands, ...body.finish], STILL_FLOATS * i);
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
    this.glass = [];
    for (let first = 0, end = 0; first < this.drawn.length; first = end) {
      const { mesh, look } = this.drawn[first];
      while (end < this.drawn.length && this.drawn[end].mesh === mesh && this.drawn[end].look === look) ++end;
      if (look !== GLASS) this.groups.push(this.meshGroup(mesh, first, end - first));
      else for (let i = first; i < end; ++i) this.glass.push(this.meshGroup(mesh, i, 1));
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
    instances(this.still, STILL_FLOATS, [[3, 3], [4, 3], [8, 1], [9, 4]]);
    instances(this.moving, MOVING_FLOATS, [[5, 3], [6, 4], [7, 4]]);
    return array;
  }

  meshGroup(number, first, count) {
    const { gl } = this, { mesh, buffers } = this.meshBuffers(number), array = this.vertexArray(first);
    buffers.vertices.forEach(([location, buffer, size, kind]) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, kind, true, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.corners);
    const programs = this.programsOf(this.drawn[first].look, mesh.places !== null);
    return { array, first, count, programs, indices: mesh.indices.length, kind: buffers.kind };
  }

  /** Of a mesh, made when it is first asked for. */
  meshBuffers(number) {
    const { gl } = this, mesh = this.recording.meshes[number];
    this.buffers ??= new Map();
    if (!this.buffers.has(number)) {
      const filled = (target, data) => {
        const buffer = gl.createBuffer();
        gl.bindBuffer(target, buffer);
        gl.bufferData(target, data, gl.STATIC_DRAW);
        return buffer;
      };
      gl.bindVertexArray(null);
      const small = mesh.vertices < 65536;
      this.buffers.set(number, {
        vertices: [[0, filled(gl.ARRAY_BUFFER, mesh.positions), 4, gl.UNSIGNED_SHORT],
                   [1, filled(gl.ARRAY_BUFFER, mesh.normals), 2, gl.SHORT],
                   [2, filled(gl.ARRAY_BUFFER, mesh.tints), 4, gl.UNSIGNED_BYTE],
                   ...(mesh.places ? [[10, filled(gl.ARRAY_BUFFER, mesh.places), 3, gl.FLOAT]] : [])],
        corners: filled(gl.ELEMENT_ARRAY_BUFFER, small ? new Uint16Array(mesh.indices) : mesh.indices),
        kind: small ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT,
      });
    }
    return { mesh, buffers: this.buffers.get(number) };
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
    const square = checkerSquare(distance);
    frame.set([this.ground ? this.ground.z - eye[2] : -1e30, 1 / square, (eye[0] / square) % 2, (eye[1] / square) % 2], 44);
    frame.set([2000 * distance / (1 << (4 * GROUND_RINGS)), OUTLINE_PX * (globalThis.devicePixelRatio ?? 1)], 48);
    for (let i = 0; i < 2; ++i) {
      const squares = eye[i] / square, before = Math.floor(squares / PATTERN_PERIOD);
      frame[56 + i] = squares - PATTERN_PERIOD * before;
      frame[58 + i] = before;
    }
    if (this.ground) frame.set(channels(this.bodies[this.ground.body].color).map(linearLight), 60);
    const middle = sub(view.target, eye);
    frame.set([middle[0], middle[1], light.pool > 0 ? 1 / (light.pool * distance) : 0], 64);
    this.range = { near, far };
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frameBuffer);
    gl.bufferSubData(gl.UNIFORM_BUFFER, 0, frame);
    return shadow !== null;
  }

  drawGroup({ array, count, indices, kind }) {
    this.gl.bindVertexArray(array);
    this.gl.drawElementsInstanced(this.gl.TRIANGLES, indices, kind, 0, count);
  }

  /** By the one of its programs that `chosen` says. */
  drawGroups(groups, chosen) {
    for (const group of groups) {
      this.gl.useProgram(chosen(group.programs));
      this.drawGroup(group);
    }
  }

  drawShadows() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.viewport(0, 0, SHADOW_TEXELS, SHADOW_TEXELS);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.drawGroups([...this.groups, ...this.glass], ({ shadow }) => shadow);
  }

  drawScene(view, selected) {
    const { gl, programs } = this;
    gl.viewport(0, 0, view.width, view.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.CULL_FACE);
    this.drawGroups(this.groups, ({ body }) => body);
    gl.disable(gl.CULL_FACE);
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
    if (this.glass.length > 0) this.drawGlass(view);
  }

  /** Over what is behind it, the farthest first; glass beyond the copies sees none of the glass drawn since the last. */
  drawGlass(view) {
    const { gl } = this;
    const depth = ({ first }) => dot(Array.from(this.rows.subarray(MOVING_FLOATS * first, MOVING_FLOATS * first + 3)), view.forward);
    gl.enable(gl.CULL_FACE);
    [...this.glass].sort((a, b) => depth(b) - depth(a)).forEach((group, i) => {
      if (i < MOST_COPIES) this.offscreen.copy([gl.COLOR_BUFFER_BIT]);
      gl.useProgram(group.programs.body);
      this.drawGroup(group);
    });
    gl.disable(gl.CULL_FACE);
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
      this.outlines.set(place, this.meshGroup(this.drawn[place].mesh, place, 1));
    gl.useProgram(this.programs.outline);
    gl.enable(gl.CULL_FACE);
    gl.cullFace(gl.FRONT);
    this.drawGroup(this.outlines.get(place));
    gl.cullFace(gl.BACK);
    gl.disable(gl.CULL_FACE);
  }

  /** `moment`: time, colors, selected. */
  draw(view, moment) {
    const { gl } = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    this.placeBodies(view, moment.colors);
    if (this.placeFrame(view)) this.drawShadows();
    if (this.isFinished) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      this.drawScene(view, moment.selected);
      return;
    }
    this.offscreen.begin(view);
    this.drawScene(view, moment.selected);
    this.offscreen.copy([gl.COLOR_BUFFER_BIT, gl.DEPTH_BUFFER_BIT]);
    this.water.finish(view, moment.time, this.range);
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
    this.drawGroups([...this.groups, ...this.glass], () => this.programs.id);
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
