// Which part of the world the shadow map covers: the bodies that cast, seen from the sun, cut to what the camera can
// see; in steps and on a grid fixed in the world, so that shadows do not crawl (renderer/view/shadow_fit.h).

import { add, clamp, cross, dot, norm, scaled, sub, unit } from "./geometry.js";

const RECEIVER_REACH = 1.6, STEPS_PER_DOUBLING = 4, BORDER_TEXELS = 6, GRIDS_PER_SIDE = 16;

const steppedUp = x => 2 ** (Math.ceil(Math.log2(x) * STEPS_PER_DOUBLING) / STEPS_PER_DOUBLING);
const snappedDown = (x, grid, eye) => Math.floor((x + eye) / grid) * grid - eye;

/** Of balls `casters` ({ center_E, radius }) in frame E; null when no shadow can be seen. */
export function fitShadow(view, toSun, casters, texels) {
  const z = unit(toSun);
  let x = sub(view.forward, scaled(z, dot(view.forward, z)));
  if (norm(x) < 1e-3) x = sub(view.right, scaled(z, dot(view.right, z)));
  x = unit(x);
  const axes = [x, cross(z, x), z];
  const corners = [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([sx, sy]) =>
    add(view.forward, add(scaled(view.right, sx * 0.5 * view.width / view.focal),
                          scaled(view.up, sy * 0.5 * view.height / view.focal))));
  let kept = casters, reach = 0, visible = [];
  for (let round = 0; round < 3; ++round) {
    reach = kept.reduce((most, c) => Math.max(most, RECEIVER_REACH * (norm(c.center_E) + c.radius)), 0);
    visible = axes.slice(0, 2).map(axis => {
      const ends = corners.map(corner => reach * dot(axis, corner)).concat(0);
      return [Math.min(...ends), Math.max(...ends)];
    });
    kept = kept.filter(c => visible.every(([low, high], i) => {
      const middle = dot(axes[i], c.center_E);
      return middle - c.radius <= high && middle + c.radius >= low;
    }));
  }
  if (kept.length === 0) return null;
  const ranges = axes.map((axis, i) => {
    let low = Infinity, high = -Infinity;
    for (const c of kept) {
      const middle = dot(axis, c.center_E);
      low = Math.min(low, middle - c.radius);
      high = Math.max(high, middle + c.radius);
    }
    return i < 2 ? [Math.max(low, visible[i][0]), Math.min(high, visible[i][1])] : [low, high];
  });
  const side = Math.max(ranges[0][1] - ranges[0][0], ranges[1][1] - ranges[1][0]);
  return side > 0 ? placed(axes, ranges, side, view.eye, texels) : null;
}

function placed(axes, ranges, side, eye, texels) {
  const border = BORDER_TEXELS / texels;
  const size = steppedUp(side / (1 - 2 * border - 1 / GRIDS_PER_SIDE));
  const rows = [];
  for (let i = 0; i < 2; ++i) {
    const low = snappedDown(ranges[i][0] - border * size, size / GRIDS_PER_SIDE, dot(axes[i], eye));
    rows.push([...scaled(axes[i], 1 / size), -low / size]);
  }
  const texel = size / texels, length = ranges[2][1] - ranges[2][0];
  const margin = 0.01 * length + texel, grid = steppedUp(length + 2 * margin) / GRIDS_PER_SIDE;
  const along = dot(axes[2], eye);
  const low = snappedDown(ranges[2][0] - margin, grid, along), high = -snappedDown(-(ranges[2][1] + margin), grid, -along);
  rows.push([...scaled(axes[2], -1 / (high - low)), high / (high - low)]);
  return { rows, texel };
}

/** The side of the checker's squares: 1 m where that is of use, else a power of ten. */
export function checkerSquare(distance) {
  let square = 1;
  while (distance < 2.5 * square && square > 1e-6) square *= 0.1;
  while (distance > 100 * square && square < 1e6) square *= 10;
  return square;
}

/** The nearest depth that is drawn: as far away as what is seen allows. */
export function nearDepth(view, positions, bodies, groundHeight) {
  let near = view.distance;
  for (let i = 0; i < bodies.length; ++i) {
    const p = [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
    const depth = dot(sub(p, view.eye), view.forward), radius = bodies[i].radius;
    if (depth > -radius && !bodies[i].endless) near = Math.min(near, 0.9 * (depth - radius));
  }
  if (groundHeight !== null) near = Math.min(near, 0.3 * Math.abs(groundHeight));
  return clamp(near, 1e-3 * view.distance, view.distance);
}
