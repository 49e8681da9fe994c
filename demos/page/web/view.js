// The camera as a visitor moves it: drag to turn, two fingers, the right button or shift to shift, wheel or pinch to
// come nearer. A click that does not move is told of.

import { add, clamp, norm, scaled, sub, viewOf } from "./geometry.js";

const TURN = 0.006;  // Radians a pixel.
const STEEPEST = 1.55, CLICK_PX = 5;

export class Visitor {
  /** `told`: moved(camera), clicked(x, y), doubled(x, y); `camera` asks where it is now. */
  constructor(element, camera, told, groundHeight) {
    Object.assign(this, { element, camera, told, groundHeight, pointers: new Map(), travelled: 0 });
    element.addEventListener("pointerdown", event => this.down(event));
    element.addEventListener("pointermove", event => this.move(event));
    for (const kind of ["pointerup", "pointercancel"]) element.addEventListener(kind, event => this.up(event));
    element.addEventListener("wheel", event => this.wheel(event), { passive: false });
    element.addEventListener("contextmenu", event => event.preventDefault());
    element.addEventListener("dblclick", event => told.doubled(event.offsetX, event.offsetY));
  }

  down(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (this.pointers.size === 1) this.travelled = 0;
    else this.travelled = Infinity;
  }

  up(event) {
    const known = this.pointers.delete(event.pointerId);
    if (known && event.type === "pointerup" && this.travelled < CLICK_PX && event.button === 0)
      this.told.clicked(event.offsetX, event.offsetY);
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const now = { x: event.offsetX, y: event.offsetY };
    const dx = now.x - last.x, dy = now.y - last.y;
    this.travelled += Math.abs(dx) + Math.abs(dy);
    if (this.travelled < CLICK_PX) return;
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const before = Math.hypot(last.x - other.x, last.y - other.y), after = Math.hypot(now.x - other.x, now.y - other.y);
      this.shift(dx / 2, dy / 2);
      if (before > 10 && after > 10) this.zoom(before / after);
    } else if (event.shiftKey || event.ctrlKey || event.buttons & 6) {
      this.shift(dx, dy);
    } else {
      this.turn(-dx * TURN, dy * TURN);
    }
    this.pointers.set(event.pointerId, now);
  }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.zoom(Math.exp(clamp(event.deltaY * lines, -120, 120) * 0.0015));
  }

  /** About what the camera looks at. */
  turn(around, over) {
    const { eye, target, fov } = this.camera();
    const from = sub(eye, target), length = norm(from);
    const azimuth = Math.atan2(from[1], from[0]) + around;
    const elevation = clamp(Math.asin(clamp(from[2] / length, -1, 1)) + over, -STEEPEST, STEEPEST);
    const flat = length * Math.cos(elevation);
    const turned = [flat * Math.cos(azimuth), flat * Math.sin(azimuth), length * Math.sin(elevation)];
    this.told.moved(this.above({ eye: add(target, turned), target, fov }));
  }

  shift(dx, dy) {
    const { eye, target, fov } = this.camera();
    const view = viewOf({ eye, target, fov }, this.element.clientWidth, this.element.clientHeight);
    const metres = view.distance / view.focal;
    const by = add(scaled(view.right, -dx * metres), scaled(view.up, dy * metres));
    this.told.moved(this.above({ eye: add(eye, by), target: add(target, by), fov }));
  }

  zoom(factor) {
    const { eye, target, fov } = this.camera();
    this.told.moved(this.above({ eye: add(target, scaled(sub(eye, target), factor)), target, fov }));
  }

  /** Not under the ground. */
  above(camera) {
    if (this.groundHeight === null) return camera;
    const lowest = this.groundHeight + 0.004 * norm(sub(camera.eye, camera.target));
    if (camera.eye[2] < lowest) camera.eye = [camera.eye[0], camera.eye[1], lowest];
    return camera;
  }
}
