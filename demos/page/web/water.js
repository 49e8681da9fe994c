// Bodies of water over the finished scene, which is drawn into textures first: colour and depth.

import { channels, linearLight } from "./geometry.js";
import { linked } from "./program.js";

const VOLUMES = 4, WAVES = 12, SAMPLES = 4;
const COLOR_DEPTH_M = 2, DARKEST = 0.004, SCATTERED = 0.6, ENDLESS = 1e7;
const FOAM_PX = 0.9, FOAM_SHARE = 1 / 480;

export class Water {
  constructor(gl, water) {
    this.gl = gl;
    this.volumes = water.slice(0, VOLUMES).map(volume => ({
      ...volume,
      low: volume.low.map(x => x ?? -ENDLESS),
      high: volume.high.map(x => x ?? ENDLESS),
      light: channels(volume.color).map(linearLight),
      waves: [...volume.waves].sort((a, b) => Math.abs(b.height) - Math.abs(a.height)).slice(0, WAVES),
    }));
    this.program = linked(gl, "sky.vert", "water.frag");
    const at = name => gl.getUniformLocation(this.program, name);
    this.places = Object.fromEntries(["volumes", "low", "high", "absorption", "scattered", "waves", "depth_range"]
      .map(name => [name, at(name)]));
    gl.uniform1i(at("scene_color"), 1);
    gl.uniform1i(at("scene_depth"), 2);
    this.nothing = gl.createVertexArray();
    this.width = this.height = 0;
  }

  /** Targets of this size: one of several samples a pixel, and the textures that it becomes. */
  resize(width, height) {
    const { gl } = this;
    for (const old of [this.color, this.depth]) if (old) gl.deleteTexture(old);
    Object.assign(this, { width, height, color: gl.createTexture(), depth: gl.createTexture() });
    this.many ??= { target: gl.createFramebuffer(), color: gl.createRenderbuffer(), depth: gl.createRenderbuffer() };
    this.single ??= gl.createFramebuffer();
    for (const [unit, texture, format] of [[gl.TEXTURE1, this.color, gl.SRGB8_ALPHA8],
                                           [gl.TEXTURE2, this.depth, gl.DEPTH_COMPONENT24]]) {
      gl.activeTexture(unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.single);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.color, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.depth, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.many.target);
    for (const [buffer, format, place] of [[this.many.color, gl.SRGB8_ALPHA8, gl.COLOR_ATTACHMENT0],
                                           [this.many.depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, SAMPLES, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    }
  }

  /** From here on the scene is drawn into the textures. */
  begin(view) {
    if (view.width !== this.width || view.height !== this.height) this.resize(view.width, view.height);
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.many.target);
  }

  finish(view, time, range) {
    const { gl, width, height } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.many.target);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.single);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.DEPTH_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.useProgram(this.program);
    this.placeVolumes(view, time);
    gl.uniform2f(this.places.depth_range, range.near, range.far);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.nothing);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
  }

  placeVolumes(view, time) {
    const { gl, places } = this, eye = view.eye;
    const away = ({ low, high }) =>
      Math.hypot(...eye.map((x, i) => x - Math.min(Math.max(x, low[i]), high[i])));
    const sorted = [...this.volumes].sort((a, b) => away(b) - away(a));
    const rows = { low: [], high: [], absorption: [], scattered: [] }, waves = new Float32Array(4 * VOLUMES * WAVES);
    sorted.forEach((volume, v) => {
      const reach = volume.waves.reduce((sum, wave) => sum + Math.abs(wave.height), 0);
      const slope = volume.waves.reduce((sum, wave) => sum + Math.abs(wave.height) * Math.hypot(...wave.k), 0);
      rows.low.push(...volume.low.map((x, i) => x - eye[i]), volume.waves.length);
      rows.high.push(...volume.high.map((x, i) => x - eye[i]), reach);
      rows.absorption.push(...volume.light.map(x => -Math.log(Math.min(Math.max(x, DARKEST), 1)) / COLOR_DEPTH_M), slope);
      rows.scattered.push(...volume.light.map(x => SCATTERED * x), Math.max(FOAM_PX, FOAM_SHARE * view.height));
      volume.waves.forEach((wave, i) =>
        waves.set([wave.height, ...wave.k, wave.phase + wave.pace * time + wave.k[0] * eye[0] + wave.k[1] * eye[1]],
                  4 * (v * WAVES + i)));
    });
    gl.uniform1i(places.volumes, sorted.length);
    for (const [name, values] of Object.entries(rows)) gl.uniform4fv(places[name], values);
    gl.uniform4fv(places.waves, waves);
  }
}
