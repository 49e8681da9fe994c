// Bodies of water over the finished scene, which lies in textures (offscreen.js); without any the picture as it is.

import { channels, linearLight } from "./geometry.js";
import { linked } from "./program.js";

const VOLUMES = 4, WAVES = 12;
const COLOR_DEPTH_M = 2, DARKEST = 0.004, SCATTERED = 0.6, ENDLESS = 1e7;
const FOAM_PX = 0.9, FOAM_SHARE = 1 / 480;

export class Water {
  constructor(gl, water, lines) {
    this.gl = gl;
    this.volumes = water.slice(0, VOLUMES).map(volume => ({
      ...volume,
      low: volume.low.map(x => x ?? -ENDLESS),
      high: volume.high.map(x => x ?? ENDLESS),
      light: channels(volume.color).map(linearLight),
      waves: [...volume.waves].sort((a, b) => Math.abs(b.height) - Math.abs(a.height)).slice(0, WAVES),
    }));
    this.program = linked(gl, "sky_vertex", "water.frag", { lines });
    const at = name => gl.getUniformLocation(this.program, name);
    this.places = Object.fromEntries(["volumes", "low", "high", "absorption", "scattered", "waves", "depth_range"]
      .map(name => [name, at(name)]));
    this.nothing = gl.createVertexArray();
  }

  /** Onto the canvas. */
  finish(view, time, range) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, view.width, view.height);
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
    if (sorted.length === 0) return;
    for (const [name, values] of Object.entries(rows)) gl.uniform4fv(places[name], values);
    gl.uniform4fv(places.waves, waves);
  }
}
