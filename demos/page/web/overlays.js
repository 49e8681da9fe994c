// The engine's overlays over the picture: the same marks and colours as `carom render --overlay`, on a plain canvas.
// What was recorded for a frame is carried along with its bodies between two frames.

import { add, projected, rotated, scaled, sub, tangents, unit } from "./geometry.js";

export const OVERLAYS = [
  { name: "contacts", text: "points of contact and their normals", color: "#004d9e" },
  { name: "impulses", text: "what contacts and collisions took", color: "#d98000" },
  { name: "modes", text: "bodies in the colour of what they do", color: "#009e73" },
  { name: "gaps", text: "each body\u2019s distance to its nearest neighbour", color: "#cc3300" },
  { name: "regions", text: "closest features and V-regions of the nearest pair", color: "#1a80cc" },
  { name: "velocities", text: "where bodies go in 0.15 s", color: "#008057" },
  { name: "trails", text: "where bodies were in the last 2 s", color: "#9e3385" },
  { name: "names", text: "of the bodies that move", color: "#141419" },
];

const BLUE = "#004d9e", SKY = "#1a80cc", GREEN = "#008057", ORANGE = "#d98000", RED = "#cc3300", PURPLE = "#9e3385";
const HALO = "rgba(255, 255, 255, 0.75)", INK = "#141419";
const VELOCITY_TIME_S = 0.15, TRAIL_TIME_S = 2;
const MOST_LABELS = 10, MOST_NAMED_IMPULSES = 6;

export function lengthText(metres) {
  const size = Math.abs(metres);
  if (size < 1e-4) return `${(1e6 * metres).toPrecision(3)} \u00b5m`;
  return size < 0.1 ? `${(1e3 * metres).toPrecision(3)} mm` : `${metres.toPrecision(3)} m`;
}

export class Ink {
  constructor(canvas, recording) {
    Object.assign(this, { canvas, recording, context: canvas.getContext("2d") });
  }

  /** `pixels`: how many of the canvas make one of the page. */
  draw(view, frame, chosen, pixels) {
    const { context, canvas } = this;
    Object.assign(this, { view, frame, pixels, labels: [] });
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.lineJoin = context.lineCap = "round";
    const drawings = { regions: this.regions, trails: this.trails, gaps: this.gaps, contacts: this.contacts,
                       impulses: this.impulses, velocities: this.velocities, names: this.names };
    for (const [name, drawing] of Object.entries(drawings)) if (chosen.has(name)) drawing.call(this);
    for (const label of this.labels) this.writeLabel(label);
  }

  /** A point of the frame's record, where its body has carried it since. */
  carried(point, body) {
    const track = this.recording.tracks[body];
    if (!track.moves) return point;
    const at = 3 * this.frame, now = this.recording.positionOf(body);
    return add(point, sub(now, track.position.subarray(at, at + 3)));
  }

  /** Of two bodies the one that moves. */
  mover(a, b) {
    return this.recording.tracks[b].moves ? b : a;
  }

  path(points) {
    const { context } = this;
    let open = false;
    context.beginPath();
    for (const point of points) {
      const at = projected(this.view, point);
      if (at === null) open = false;
      else if (open) context.lineTo(at.x, at.y);
      else context.moveTo(at.x, at.y), open = true;
    }
  }

  line(points, color, width, { closed = false, dashed = false } = {}) {
    const { context } = this;
    this.path(closed ? [...points, points[0]] : points);
    context.setLineDash(dashed ? [6 * this.pixels, 4 * this.pixels] : []);
    for (const [style, extra] of [[HALO, 1.6], [color, 0]]) {
      context.strokeStyle = style;
      context.lineWidth = (width + extra) * this.pixels;
      context.stroke();
    }
    context.setLineDash([]);
  }

  area(points, color, opacity) {
    this.path(points);
    this.context.globalAlpha = opacity;
    this.context.fillStyle = color;
    this.context.fill();
    this.context.globalAlpha = 1;
  }

  dot(point, color, radius) {
    const at = projected(this.view, point), { context } = this;
    if (at === null) return;
    context.beginPath();
    context.arc(at.x, at.y, radius * this.pixels, 0, 2 * Math.PI);
    context.fillStyle = color;
    context.strokeStyle = HALO;
    context.lineWidth = this.pixels;
    context.stroke();
    context.fill();
  }

  arrow(foot, tip, color, width) {
    const a = projected(this.view, foot), b = projected(this.view, tip), { context } = this;
    if (a === null || b === null) return;
    const length = Math.hypot(b.x - a.x, b.y - a.y);
    if (length < 1.5 * this.pixels) return this.dot(foot, color, width);
    const head = Math.min(3.6 * width * this.pixels, 0.6 * length);
    const ux = (b.x - a.x) / length, uy = (b.y - a.y) / length, neck = { x: b.x - head * ux, y: b.y - head * uy };
    for (const [style, extra] of [[HALO, 1.6 * this.pixels], [color, 0]]) {
      context.strokeStyle = context.fillStyle = style;
      context.lineWidth = width * this.pixels + extra;
      context.beginPath();
      context.moveTo(a.x, a.y);
      context.lineTo(neck.x, neck.y);
      context.stroke();
      context.beginPath();
      context.moveTo(b.x, b.y);
      context.lineTo(neck.x - 0.45 * head * uy, neck.y + 0.45 * head * ux);
      context.lineTo(neck.x + 0.45 * head * uy, neck.y - 0.45 * head * ux);
      context.closePath();
      context.lineWidth = extra;
      if (extra > 0) context.stroke();
      context.fill();
    }
  }

  label(point, text, color) {
    const at = projected(this.view, point);
    if (at !== null && this.labels.length < 40) this.labels.push({ ...at, text, color });
  }

  writeLabel({ x, y, text, color }) {
    const { context, pixels } = this;
    context.font = `600 ${11.5 * pixels}px system-ui, sans-serif`;
    const width = context.measureText(text).width, height = 17 * pixels, pad = 6 * pixels;
    const left = Math.min(Math.max(x + 9 * pixels, 2), this.view.width - width - 2 * pad - 2);
    const top = Math.min(Math.max(y - height - 4 * pixels, 2), this.view.height - height - 2);
    context.fillStyle = "rgba(255, 255, 255, 0.9)";
    context.beginPath();
    context.roundRect(left, top, width + 2 * pad, height, height / 2);
    context.fill();
    context.fillStyle = color;
    context.textBaseline = "middle";
    context.fillText(text, left + pad, top + 0.53 * height);
  }

  contacts() {
    for (const { a, b, p, n } of this.recording.contacts.pointsOf(this.frame)) {
      const foot = this.carried(p, this.mover(a, b));
      this.arrow(foot, add(foot, n), BLUE, 2);
      this.dot(foot, PURPLE, 2.2);
    }
  }

  impulses() {
    let named = 0;
    for (const { body, collision, foot, arrow, size } of this.recording.contacts.impulsesOf(this.frame)) {
      const from = this.carried(foot, body);
      this.arrow(from, add(from, arrow), collision ? RED : ORANGE, collision ? 3 : 2.2);
      if (collision && named++ < MOST_NAMED_IMPULSES) this.label(from, `${size.toPrecision(3)} N s`, RED);
    }
  }

  gaps() {
    const pairs = this.recording.contacts.distancesOf(this.frame);
    pairs.forEach(({ a, b, p_a, p_b, distance }, i) => {
      const from = this.carried(p_a, a), to = this.carried(p_b, b);
      this.line([from, to], INK, 1.4);
      this.dot(from, RED, 2.2);
      this.dot(to, RED, 2.2);
      if (i < MOST_LABELS) this.label(scaled(add(from, to), 0.5), lengthText(distance), INK);
    });
  }

  velocities() {
    this.recording.tracks.forEach((track, body) => {
      if (!track.moves) return;
      const v = track.velocity.subarray(3 * this.frame, 3 * this.frame + 3);
      const from = this.recording.positionOf(body);
      if (Math.hypot(...v) * VELOCITY_TIME_S > 0.05 * this.recording.bodies[body].radius)
        this.arrow(from, add(from, scaled(v, VELOCITY_TIME_S)), GREEN, 2.2);
    });
  }

  trails() {
    const first = Math.max(0, this.frame - Math.round(TRAIL_TIME_S * this.recording.fps));
    const stride = Math.max(1, Math.round(this.recording.fps / 30));
    this.recording.tracks.forEach((track, body) => {
      if (!track.moves) return;
      const points = [];
      for (let f = this.frame - (this.frame % stride); f >= first; f -= stride)
        points.push(track.position.subarray(3 * f, 3 * f + 3));
      if (points.length === 0) return;
      points.unshift(this.recording.positionOf(body));
      this.context.globalAlpha = 0.8;
      this.line(points, PURPLE, 1.4);
      this.context.globalAlpha = 1;
    });
  }

  names() {
    this.recording.bodies.forEach((body, i) => {
      if (!body.static) this.label(this.recording.positionOf(i), body.name, INK);
    });
  }

  regions() {
    const { closest } = this.recording.contacts.frames[this.frame], { contacts } = this.recording;
    if (closest === null) return;
    const { a, b, p_a, p_b } = closest, toward = unit(sub(p_b, p_a));
    const from = this.carried(p_a, a), to = this.carried(p_b, b);
    this.region(contacts.regions[closest.region_a], a, from, toward, SKY);
    this.region(contacts.regions[closest.region_b], b, to, scaled(toward, -1), ORANGE);
    this.line([from, to], INK, 1.4);
    this.dot(from, RED, 2.6);
    this.dot(to, RED, 2.6);
    this.label(scaled(add(from, to), 0.5), lengthText(closest.distance), INK);
  }

  /** The region of a feature of `body`; `outward` leads from its witness point to the other body. */
  region(region, body, witness, outward, color) {
    const q = this.recording.rotations, place = this.recording.positionOf(body);
    const placed = point => add(place, rotated(q, 4 * body, point));
    if (region.wide) return this.column(rotated(q, 4 * body, region.normal), region.reach, witness, color);
    const corners = region.corners.map(corner => add(placed(corner), scaled(outward, region.rounding)));
    for (const side of region.sides) {
      const points = side.map(placed), last = points.length - 1;
      this.area(points, color, 0.16);
      this.line([points[0], points[last]], color, 1.2);
      this.line([points[last - 1], points[last]], color, 1.2);
      if (points.length === 4) this.line([points[1], points[2]], color, 1.2);
    }
    for (const rim of region.rims) this.line(rim.map(placed), color, 1.2);
    if (corners.length > 2) this.area(corners, color, 0.3);
    if (corners.length > 1) this.line(corners, color, 2.4, { closed: corners.length > 2 });
    else this.dot(corners[0], color, 3.6);
  }

  /** Of a face that reaches far: a column over the witness, which is no border of the region. */
  column(normal, reach, witness, color) {
    const n = unit(normal), [s, t] = tangents(n);
    const low = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([x, y]) =>
      add(witness, add(scaled(s, x * reach), scaled(t, y * reach))));
    const high = low.map(corner => add(corner, scaled(n, reach)));
    this.area(low, color, 0.2);
    for (const ring of [low, high]) this.line(ring, color, 1.2, { closed: true, dashed: true });
    low.forEach((corner, i) => this.arrow(corner, high[i], color, 1.4));
  }
}
