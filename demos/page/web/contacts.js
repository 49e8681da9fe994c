// What the engine knew of contacts in each frame: points and normals, impulses, nearest pairs, closest features with
// their V-regions (demos/page/page_contacts.h). Frames are read once, in order, and kept as plain numbers.

import { scaled } from "./geometry.js";

const NORMAL_STEPS = 127, ARROW_COARSENESS = 4, LOGARITHM_STEPS = 128;

class PairReader {
  constructor() {
    this.former = new Map();
  }

  /** The pairs of the next frame: bodies a and b, and a row of numbers that continues the one before. */
  next(stream) {
    const now = new Map(), count = new Map(), pairs = [];
    for (let n = stream.whole(); n > 0; --n) {
      const a = stream.whole(), b = stream.whole(), name = `${a} ${b}`;
      const order = count.get(name) ?? 0;
      count.set(name, order + 1);
      const key = `${name} ${order}`, row = stream.wholes(stream.whole());
      const before = this.former.get(key);
      if (before && before.length === row.length)
        for (let i = 0; i < row.length; ++i) row[i] += before[i];
      now.set(key, row);
      pairs.push({ a, b, row });
    }
    this.former = now;
    return pairs;
  }
}

function readPoints(stream, quantum) {
  return Array.from({ length: stream.whole() }, () => stream.wholes(3).map(x => x * quantum));
}

function readRegion(stream, quantum) {
  const region = { wide: stream.whole() === 1, kind: stream.whole(), index: stream.whole(),
                   reach: stream.whole() * quantum, rounding: stream.whole() * quantum };
  if (region.wide) return { ...region, normal: stream.wholes(3).map(x => x / NORMAL_STEPS) };
  region.corners = readPoints(stream, quantum);
  const lines = () => Array.from({ length: stream.whole() }, () => readPoints(stream, quantum));
  region.sides = lines();
  region.rims = lines();
  return region;
}

export class Contacts {
  constructor(stream, frames, quantum) {
    this.quantum = quantum;
    this.regions = Array.from({ length: stream.whole() }, () => readRegion(stream, quantum));
    const contacts = new PairReader(), impulses = new PairReader(), distances = new PairReader();
    this.frames = Array.from({ length: frames }, () => ({
      contacts: contacts.next(stream),
      impulses: impulses.next(stream),
      distances: distances.next(stream),
      closest: stream.whole() === 1 ? this.readClosest(stream) : null,
    }));
  }

  point(row, at) {
    return [row[at] * this.quantum, row[at + 1] * this.quantum, row[at + 2] * this.quantum];
  }

  readClosest(stream) {
    const [a, b, region_a, region_b] = stream.wholes(4), row = stream.wholes(6);
    return { a, b, region_a, region_b, p_a: this.point(row, 0), p_b: this.point(row, 3),
             distance: stream.logarithm() };
  }

  /** Points of contact with the normals from the first body to the second, as long as they are drawn. */
  pointsOf(frame) {
    const points = [];
    for (const { a, b, row } of this.frames[frame].contacts)
      for (let at = 1; at < row.length; at += 6) {
        const length = row[0] * this.quantum / NORMAL_STEPS;
        points.push({ a, b, p: this.point(row, at),
                      n: [row[at + 3] * length, row[at + 4] * length, row[at + 5] * length] });
      }
    return points;
  }

  /** Pairs of bodies with their nearest points, of each body that can move the nearest. */
  distancesOf(frame) {
    return this.frames[frame].distances.map(({ a, b, row }) =>
      ({ a, b, p_a: this.point(row, 0), p_b: this.point(row, 3), distance: 2 ** (row[6] / LOGARITHM_STEPS) }));
  }

  /** What contacts took, the strongest collision first, as arrows from the point of contact. */
  impulsesOf(frame) {
    return this.frames[frame].impulses.map(({ a, b, row }) =>
      ({ body: a, collision: b === 1, foot: this.point(row, 0), arrow: scaled(this.point(row, 3), ARROW_COARSENESS),
         size: 2 ** (row[6] / LOGARITHM_STEPS) }));
  }
}
