// The run: facts, shapes, poses, velocities, modes and cameras of every frame, and what lies between two frames.

import { Contacts } from "./contacts.js";
import { readPictures } from "./pictures.js";
import { Stream } from "./stream.js";

const PICTURE_QUANTUM = 2 ** -16;  // Of places on pictures, in their sides.

function readMesh(stream) {
  const vertices = stream.whole(), triangles = stream.whole();
  const colored = stream.whole() === 1, pictured = stream.whole() === 1;
  const positions = new Uint16Array(4 * vertices), normals = new Int16Array(2 * vertices);
  const tints = new Uint8Array(4 * vertices).fill(255), indices = new Uint32Array(3 * triangles);
  for (let i = 0; i < 3; ++i) stream.differences(positions, i, 4, vertices);
  for (let i = 0; i < 2; ++i) stream.differences(normals, i, 2, vertices);
  for (let i = 0; colored && i < 3; ++i) stream.differences(tints, i, 4, vertices);
  const places = pictured ? new Float32Array(3 * vertices) : null;
  for (let i = 0; pictured && i < 3; ++i) stream.differences(places, i, 3, vertices, i < 2 ? PICTURE_QUANTUM : 1);
  stream.differences(indices, 0, 1, 3 * triangles);
  return { vertices, positions, normals, tints, places, indices };
}

/** Positions and velocities as rows of three, rotations as rows of four numbers; one row, or one a frame. */
function readTrack(stream, frames, quanta) {
  const moves = stream.whole() === 1, count = moves ? frames : 1;
  const track = { moves, position: new Float64Array(3 * count), rotation: new Float32Array(4 * count) };
  for (let i = 0; i < 3; ++i) stream.column(track.position, i, 3, count, quanta.length);
  for (let i = 0; i < 4; ++i) stream.column(track.rotation, i, 4, count, quanta.quaternion);
  if (!moves) return track;
  track.velocity = new Float32Array(3 * count);
  track.spin = new Float32Array(3 * count);
  for (let i = 0; i < 3; ++i) stream.column(track.velocity, i, 3, count, quanta.speed);
  for (let i = 0; i < 3; ++i) stream.column(track.spin, i, 3, count, quanta.spin);
  return track;
}

function readModes(stream, frames) {
  const modes = new Uint8Array(frames);
  for (let at = 0; at < frames;) {
    const mode = stream.whole(), length = stream.whole();
    modes.fill(mode, at, at + length);
    at += length;
  }
  return modes;
}

function readCamera(stream, frames, moves, quanta) {
  const count = moves ? frames : 1;
  const rows = new Float64Array(7 * count);
  for (let i = 0; i < 7; ++i) stream.column(rows, i, 7, count, i < 6 ? quanta.length : quanta.fov);
  return rows;
}

export class Recording {
  constructor(bytes) {
    const stream = new Stream(bytes);
    const facts = JSON.parse(stream.text());
    Object.assign(this, { facts, fps: facts.fps, frames: facts.frames, bodies: facts.bodies });
    this.meshes = Array.from({ length: stream.whole() }, () => readMesh(stream));
    this.pictures = readPictures(stream);
    this.tracks = this.bodies.map(() => readTrack(stream, this.frames, facts.quanta));
    const still = new Uint8Array(this.frames);
    this.modes = this.bodies.map(body => (body.static ? still : readModes(stream, this.frames)));
    this.cameras = facts.cameras.map(camera =>
      ({ ...camera, rows: readCamera(stream, this.frames, camera.moves, facts.quanta) }));
    this.contacts = new Contacts(stream, this.frames, facts.quanta.contact);
    this.duration = (this.frames - 1) / this.fps;
    // Of all bodies at the moment last asked for: x, y, z, then w, x, y, z.
    this.positions = new Float64Array(3 * this.bodies.length);
    this.rotations = new Float64Array(4 * this.bodies.length);
    this.energies = this.energyOfFrames();
    this.moveTo(0);
  }

  /** The frame that a time lies in. */
  frameAt(time) {
    return Math.min(Math.floor(time * this.fps + 1e-6), this.frames - 1);
  }

  /** Poses at a time: those of its frame, or between two frames on the straight way. */
  moveTo(time) {
    const place = Math.min(Math.max(time * this.fps, 0), this.frames - 1);
    const from = Math.floor(place + 1e-6), u = Math.max(place - from, 0);
    for (let i = 0; i < this.bodies.length; ++i) this.placeBody(i, this.tracks[i].moves ? from : 0, u);
  }

  placeBody(i, from, u) {
    const { moves, position, rotation } = this.tracks[i];
    const next = moves && u > 0 ? 1 : 0;
    for (let k = 0; k < 3; ++k) {
      const a = position[3 * from + k];
      this.positions[3 * i + k] = next ? a + u * (position[3 * from + 3 + k] - a) : a;
    }
    let square = 0;
    for (let k = 0; k < 4; ++k) {
      const a = rotation[4 * from + k];
      const q = next ? a + u * (rotation[4 * from + 4 + k] - a) : a;
      this.rotations[4 * i + k] = q;
      square += q * q;
    }
    for (let k = 0, length = Math.sqrt(square); k < 4; ++k) this.rotations[4 * i + k] /= length;
  }

  positionOf(body) {
    return [this.positions[3 * body], this.positions[3 * body + 1], this.positions[3 * body + 2]];
  }

  /** The camera of that number at a time. */
  cameraAt(number, time) {
    const { rows, moves } = this.cameras[number];
    const place = moves ? Math.min(Math.max(time * this.fps, 0), this.frames - 1) : 0;
    const from = Math.floor(place + 1e-6), u = Math.max(place - from, 0);
    const at = i => rows[7 * from + i] + (u > 0 ? u * (rows[7 * from + 7 + i] - rows[7 * from + i]) : 0);
    return { eye: [at(0), at(1), at(2)], target: [at(3), at(4), at(5)], fov: at(6) };
  }

  /** Speed, spin, energies and mode of a body in a frame. */
  motionOf(body, frame) {
    const { mass, inertia } = this.bodies[body], track = this.tracks[body];
    const row = track.moves ? frame : 0;
    const p = track.position.subarray(3 * row, 3 * row + 3);
    const v = track.moves ? track.velocity.subarray(3 * row, 3 * row + 3) : [0, 0, 0];
    const w = track.moves ? track.spin.subarray(3 * row, 3 * row + 3) : [0, 0, 0];
    const motion = { mode: this.modes[body][frame], position: p, velocity: v, speed: Math.hypot(...v),
                     spin: Math.hypot(...w) };
    if (!mass) return motion;
    // I omega . omega in the body's own axes.
    const q = track.rotation.subarray(4 * row, 4 * row + 4);
    const [x, y, z] = turnedBack(q, w);
    const [a, b, c, d, e, f] = inertia;
    const turning = a * x * x + b * y * y + c * z * z + 2 * (d * x * y + e * x * z + f * y * z);
    const g = this.facts.gravity;
    motion.kinetic = 0.5 * (mass * motion.speed * motion.speed + turning);
    motion.potential = -mass * (g[0] * p[0] + g[1] * p[1] + g[2] * p[2]);
    return motion;
  }

  /** The kinetic energy of all bodies in every frame. */
  energyOfFrames() {
    const sums = new Float64Array(this.frames);
    for (let body = 0; body < this.bodies.length; ++body) {
      if (!this.bodies[body].mass || !this.tracks[body].moves) continue;
      for (let frame = 0; frame < this.frames; ++frame) sums[frame] += this.motionOf(body, frame).kinetic;
    }
    return sums;
  }
}

/** `v` in the frame that the quaternion turns into the world. */
function turnedBack(q, v) {
  const [w, x, y, z] = q;
  const tx = 2 * (z * v[1] - y * v[2]), ty = 2 * (x * v[2] - z * v[0]), tz = 2 * (y * v[0] - x * v[1]);
  return [v[0] + w * tx + z * ty - y * tz, v[1] + w * ty + x * tz - z * tx, v[2] + w * tz + y * tx - x * ty];
}
