// Vectors, quaternions (w, x, y, z) and the camera: the same pinhole as the renderer's (renderer/view/projection.h).
// World axes, z up, metres.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const norm = a => Math.hypot(a[0], a[1], a[2]);
export const unit = a => scaled(a, 1 / (norm(a) || 1));
export const mix = (a, b, u) => [a[0] + (b[0] - a[0]) * u, a[1] + (b[1] - a[1]) * u, a[2] + (b[2] - a[2]) * u];
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** The vector `v` turned by the quaternion that begins at `q[at]`. */
export function rotated(q, at, v) {
  const w = q[at], x = q[at + 1], y = q[at + 2], z = q[at + 3];
  const tx = 2 * (y * v[2] - z * v[1]), ty = 2 * (z * v[0] - x * v[2]), tz = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

/** Two unit vectors at right angles to `n` and to each other. */
export function tangents(n) {
  const a = unit(cross(Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], n));
  return [a, cross(n, a)];
}

/** The camera's axes in the world; image-up leans to +z, and to +y when it looks straight up or down. */
export function cameraAxes(camera) {
  const forward = unit(sub(camera.target, camera.eye));
  let right = cross(forward, [0, 0, 1]);
  if (norm(right) < 1e-6) right = cross(forward, [0, 1, 0]);
  right = unit(right);
  return { right, up: cross(right, forward), forward };
}

const RADIANS = Math.PI / 180;
/** Scenes' cameras are made for 16:9; in a picture narrower than this the sides stay where they are. */
export const KEPT_ASPECT = 1.4;

/** What is needed to draw and to point: axes and focal length in pixels, for a picture of this size. */
export function viewOf(camera, width, height) {
  const half = Math.tan(0.5 * camera.fov * RADIANS) * Math.max(1, KEPT_ASPECT / (width / height));
  return { ...camera, ...cameraAxes(camera), width, height, focal: 0.5 * height / half,
           distance: norm(sub(camera.target, camera.eye)) };
}

/** Where a point is drawn, from the upper left corner; null beside or behind the eye. `depth` in metres. */
export function projected(view, p) {
  const e = sub(p, view.eye);
  const depth = dot(e, view.forward);
  if (!(depth > 1e-3 * view.distance)) return null;
  const scale = view.focal / depth;
  return { x: 0.5 * view.width + scale * dot(e, view.right), y: 0.5 * view.height - scale * dot(e, view.up), depth };
}

/** "#rrggbb" as three numbers from 0 to 1. */
export const channels = hex => [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16) / 255);
/** What an sRGB channel means as light. */
export const linearLight = c => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
