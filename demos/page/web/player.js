// The page: reads the run, draws it, and does what a visitor asks for.

import { bodyFacts, drawEnergy, element, modeCounts, writeAbout } from "./facts.js";
import { add, channels, clamp, linearLight, sub, viewOf } from "./geometry.js";
import { Graphics } from "./graphics.js";
import { readLink, writeLink } from "./link.js";
import { Ink, OVERLAYS } from "./overlays.js";
import { Recording } from "./recording.js";
import { unpacked } from "./stream.js";
import { Visitor } from "./view.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const HOLD_S = 0.9;         // How long the end is shown before it begins again.
const LINK_EVERY_MS = 500;  // Browsers allow some hundred changes of the address in a minute.
const MOST_PIXELS_A_SIDE = 4096, KEY_TURN = 0.06, KEY_ZOOM = 1.08;
const KEYS = [["space", "play, pause"], ["\u2190 \u2192", "a frame back, forth"], ["shift \u2190 \u2192", "half a second"],
              ["\u2191 \u2193", "faster, slower"], ["home end", "first, last frame"], ["C", "next camera"],
              ["1 \u2026 8", "overlays"], ["W A S D", "turn the camera"], ["+ \u2212", "nearer, farther"],
              ["N", "next body"], ["F", "full screen"], ["drag", "turn"], ["shift drag", "shift"], ["wheel, pinch", "nearer"],
              ["click", "a body\u2019s facts"], ["double click", "look at a point"]];

const byId = id => document.getElementById(id);

class Player {
  constructor(recording) {
    Object.assign(this, { recording, stage: byId("stage"), chosen: new Set(), time: 0, speed: 1, playing: false,
                          camera: 0, free: null, selected: null, follows: false, dirty: true, held: 0 });
    this.picture = byId("picture");
    this.graphics = new Graphics(this.picture, recording);
    this.ink = new Ink(byId("ink"), recording);
    this.modeColors = recording.facts.modes.map(mode => channels(mode.color).map(linearLight));
    this.writePage();
    this.visitor = new Visitor(byId("touch"), () => this.cameraNow(), {
      moved: camera => this.moveFree(camera),
      clicked: (x, y) => this.select(this.bodyAt(x, y)),
      doubled: (x, y) => this.lookAt(this.bodyAt(x, y)),
    }, recording.facts.ground?.z ?? null);
    this.listen();
    const asked = this.takeLink(location.hash);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.setPlaying(!still && asked.t === undefined && recording.frames > 1);
    requestAnimationFrame(now => this.tick(now));
  }

  // The page's parts.

  writePage() {
    const { recording } = this, { scene, impulses, leftOut } = recording.facts;
    byId("name").textContent = scene.name.replaceAll("-", " ");
    byId("what").textContent = scene.description;
    if (scene.index) {
      byId("index").href = scene.index;
      byId("index").hidden = false;
    }
    for (const camera of recording.cameras) byId("camera").append(element("option", { value: camera.name }, camera.name));
    byId("camera").append(element("option", { value: "free", disabled: true }, "free"));
    for (const speed of SPEEDS) byId("speed").append(element("option", { value: speed }, `${speed}\u00d7`));
    for (const overlay of OVERLAYS) {
      const box = element("input", { type: "checkbox", value: overlay.name, disabled: overlay.name === "impulses" && !impulses });
      byId("overlay-list").append(element("label", { class: "choice" }, box, element("i", { swatch: overlay.color }),
        element("span", {}, overlay.name), element("small", {}, overlay.text)));
    }
    const notes = [];
    if (!impulses) notes.push("A recording holds poses, no impulses.");
    if (leftOut > 0) notes.push("In crowded frames the nearest contacts are shown.");
    byId("overlay-note").textContent = notes.join(" ");
    byId("overlay-note").hidden = notes.length === 0;
    for (const [key, text] of KEYS) byId("keys").append(element("kbd", {}, key), element("span", {}, text));
    byId("time").max = recording.frames - 1;
    byId("caption").hidden = recording.facts.captions.length === 0;
    this.stage.classList.toggle("dark", recording.facts.light.dark);
    this.stage.classList.toggle("captioned", recording.facts.captions.length > 0);
    writeAbout(recording, byId("about"));
  }

  listen() {
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    byId("back").addEventListener("click", () => this.step(-1));
    byId("forth").addEventListener("click", () => this.step(1));
    byId("time").addEventListener("input", event => this.seekByHand(Number(event.target.value) / this.recording.fps));
    byId("speed").addEventListener("change", event => this.setSpeed(Number(event.target.value)));
    byId("camera").addEventListener("change", event => this.chooseCamera(event.target.value));
    byId("overlay-list").addEventListener("change", event => this.setOverlay(event.target.value, event.target.checked));
    byId("card-close").addEventListener("click", () => this.select(null));
    byId("follow").addEventListener("click", () => this.setFollows(!this.follows));
    byId("share").addEventListener("click", () => this.share());
    byId("fullscreen").addEventListener("click", () => this.toggleFullscreen());
    byId("fullscreen").hidden = !document.fullscreenEnabled;
    addEventListener("keydown", event => this.key(event));
    addEventListener("hashchange", event => this.takeLink(new URL(event.newURL).hash));
    addEventListener("pointerdown", event => {
      for (const menu of document.querySelectorAll(".menu[open]")) if (!menu.contains(event.target)) menu.open = false;
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { this.dirty = true; });
    this.picture.addEventListener("webglcontextlost", event => event.preventDefault());
    this.picture.addEventListener("webglcontextrestored", () => {
      this.graphics = new Graphics(this.picture, this.recording);
      this.dirty = true;
    });
    // At once, before the browser shows the old picture in the new size.
    new ResizeObserver(() => this.draw()).observe(this.stage);
  }

  // Time.

  get frame() {
    return this.recording.frameAt(this.time);
  }

  seek(time) {
    this.time = clamp(time, 0, this.recording.duration);
    this.held = 0;
    this.dirty = true;
  }

  seekByHand(time) {
    this.setPlaying(false);
    this.seek(time);
    this.writeLinkSoon();
  }

  step(frames) {
    this.seekByHand((this.frame + frames) / this.recording.fps);
  }

  setPlaying(playing) {
    if (playing && this.time >= this.recording.duration) this.seek(0);
    this.playing = playing;
    this.stage.classList.toggle("playing", playing);
    byId("play").setAttribute("aria-label", playing ? "Pause" : "Play");
    if (!playing) this.writeLinkSoon();
  }

  setSpeed(speed) {
    this.speed = clamp(speed, 0.1, 4);
    const select = byId("speed"), value = String(Number(this.speed.toFixed(3)));
    if (![...select.options].some(option => option.value === value))
      select.append(element("option", { value }, `${value}\u00d7`));
    select.value = value;
    this.writeLinkSoon();
  }

  tick(now) {
    const passed = Math.min((now - (this.last ?? now)) / 1000, 0.1);
    this.last = now;
    if (this.playing) this.advance(passed);
    if (this.dirty) this.draw();
    if (this.linkAt !== undefined && now >= this.linkAt) this.writeLinkNow(now);
    requestAnimationFrame(next => this.tick(next));
  }

  advance(passed) {
    const { duration } = this.recording;
    if (this.time >= duration) {
      this.held += passed;
      if (this.held >= HOLD_S) this.seek(0);
    } else {
      this.time = Math.min(this.time + passed * this.speed, duration);
      this.dirty = true;
    }
    this.linkAt ??= this.last + LINK_EVERY_MS;
  }

  // Cameras.

  cameraNow() {
    const camera = this.free ?? this.recording.cameraAt(this.camera, this.time);
    if (!this.follows || this.free === null) return camera;
    const by = sub(this.recording.positionOf(this.selected), this.followed);
    return { eye: add(camera.eye, by), target: add(camera.target, by), fov: camera.fov };
  }

  moveFree(camera) {
    this.free = camera;
    if (this.follows) this.followed = this.recording.positionOf(this.selected);
    byId("camera").querySelector("[value=free]").disabled = false;
    byId("camera").value = "free";
    this.dirty = true;
    this.writeLinkSoon();
  }

  chooseCamera(name) {
    const number = this.recording.cameras.findIndex(camera => camera.name === name);
    if (number < 0) return;
    this.camera = number;
    this.free = null;
    this.setFollows(false);
    byId("camera").value = name;
    this.dirty = true;
    this.writeLinkSoon();
  }

  setFollows(follows) {
    const camera = this.cameraNow();
    this.follows = follows && this.selected !== null;
    byId("follow").setAttribute("aria-pressed", String(this.follows));
    if (this.follows) this.moveFree({ ...camera, target: this.recording.positionOf(this.selected) });
    else if (this.free !== null) this.moveFree(camera);
  }

  lookAt(body) {
    if (body === null) return this.chooseCamera(this.recording.cameras[this.camera].name);
    const camera = this.cameraNow(), target = this.recording.positionOf(body);
    const by = sub(target, camera.target);
    this.moveFree({ eye: add(camera.eye, by), target, fov: camera.fov });
  }

  // Bodies and overlays.

  bodyAt(x, y) {
    const pixels = this.view.width / byId("touch").clientWidth;
    return this.graphics.pick(this.view, x * pixels, y * pixels);
  }

  select(body) {
    if (this.follows) this.setFollows(false);
    this.selected = body;
    byId("card").hidden = body === null;
    this.dirty = true;
    this.writeLinkSoon();
  }

  selectNext() {
    const moving = this.recording.bodies.map((body, i) => i).filter(i => !this.recording.bodies[i].static);
    if (moving.length > 0) this.select(moving[(moving.indexOf(this.selected) + 1) % moving.length]);
  }

  setOverlay(name, shown) {
    if (!OVERLAYS.some(overlay => overlay.name === name)) return;
    if (name === "impulses" && !this.recording.facts.impulses) return;
    this.chosen[shown ? "add" : "delete"](name);
    byId("overlay-list").querySelector(`[value=${name}]`).checked = shown;
    byId("overlay-count").textContent = this.chosen.size || "";
    this.dirty = true;
    this.writeLinkSoon();
  }

  // Drawing.

  resize() {
    const pixels = Math.min(globalThis.devicePixelRatio || 1, 2);
    const side = length => clamp(Math.round(length * pixels), 1, MOST_PIXELS_A_SIDE);
    const width = side(this.stage.clientWidth), height = side(this.stage.clientHeight);
    for (const canvas of [this.picture, this.ink.canvas])
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    return { width, height, pixels };
  }

  draw() {
    this.dirty = false;
    const { width, height, pixels } = this.resize(), { frame } = this;
    this.recording.moveTo(this.time);
    this.view = viewOf(this.cameraNow(), width, height);
    const shows_modes = this.chosen.has("modes");
    const colors = shows_modes ? body => (this.recording.bodies[body].checker ? null
      : this.modeColors[this.recording.modes[body][frame]]) : null;
    this.graphics.draw(this.view, { time: this.time, colors, selected: this.selected });
    this.ink.draw(this.view, frame, this.chosen, pixels);
    this.writeState(frame, shows_modes);
  }

  writeState(frame, shows_modes) {
    const { recording } = this;
    byId("time").value = Math.round(this.time * recording.fps);
    byId("time").setAttribute("aria-valuetext", `${this.time.toFixed(2)} seconds`);
    byId("clock").replaceChildren(`${this.time.toFixed(3)} s`, element("small", {}, `frame ${frame} of ${recording.frames - 1}`));
    const { captions } = recording.facts, caption = captions[Math.min(frame, captions.length - 1)] ?? "";
    if (byId("caption").textContent !== caption) byId("caption").textContent = caption;
    drawEnergy(byId("energy"), recording, this.time / (recording.duration || 1));
    byId("legend").hidden = !shows_modes;
    if (shows_modes) this.writeLegend(frame);
    if (this.selected === null) return;
    byId("card-name").textContent = recording.bodies[this.selected].name;
    byId("card-facts").replaceChildren(...bodyFacts(recording, this.selected, frame).flatMap(([name, value]) =>
      [element("dt", {}, name), element("dd", {}, ...value)]));
  }

  writeLegend(frame) {
    const counts = modeCounts(this.recording, frame);
    byId("legend").replaceChildren(...this.recording.facts.modes.flatMap((mode, i) =>
      (counts[i] > 0 ? [element("li", {}, element("i", { swatch: mode.color }), `${mode.name} ${counts[i]}`)] : [])));
  }

  // The link to the moment.

  takeLink(hash) {
    if (hash === this.written) return {};
    const asked = readLink(hash);
    if (asked.t !== undefined) this.seek(asked.t);
    this.recording.moveTo(this.time);
    if (asked.speed !== undefined) this.setSpeed(asked.speed);
    else byId("speed").value = "1";
    if (asked.overlays) for (const { name } of OVERLAYS) this.setOverlay(name, asked.overlays.includes(name));
    if (asked.body) {
      const body = this.recording.bodies.findIndex(({ name }) => name === asked.body);
      if (body >= 0) this.select(body);
    }
    if (asked.camera === "free" && asked.eye && asked.target && Math.hypot(...sub(asked.eye, asked.target)) > 0)
      this.moveFree({ eye: asked.eye, target: asked.target, fov: asked.fov ?? 40 });
    else if (asked.camera) this.chooseCamera(asked.camera);
    if (asked.t !== undefined && this.playing) this.setPlaying(false);
    return asked;
  }

  link() {
    const camera = this.cameraNow();
    return writeLink({ t: this.time, speed: this.speed,
                       camera: this.free ? "free" : this.recording.cameras[this.camera].name, ...camera,
                       overlays: OVERLAYS.map(({ name }) => name).filter(name => this.chosen.has(name)),
                       body: this.selected === null ? "" : this.recording.bodies[this.selected].name });
  }

  writeLinkSoon() {
    this.linkAt ??= (this.last ?? 0) + 60;
  }

  writeLinkNow(now) {
    this.linkAt = this.playing ? now + LINK_EVERY_MS : undefined;
    const link = this.link();
    if (link === this.written) return;
    this.written = link;
    try {
      history.replaceState(null, "", link);
    } catch {
      location.replace(link);  // a page from disk may not have a history of its own
    }
  }

  async share() {
    this.writeLinkNow(performance.now());
    try {
      await navigator.clipboard.writeText(location.href);
      byId("share").textContent = "copied";
    } catch {
      byId("share").textContent = "see address";
    }
    setTimeout(() => { byId("share").textContent = "link"; }, 1500);
  }

  toggleFullscreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.stage.requestFullscreen?.();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { target, key } = event;
    if (target.closest("select") || (target.closest("pre") && key.startsWith("Arrow"))) return;
    if (key === " " && target.closest("button, summary, input[type=checkbox]")) return;
    const action = this.actionOf(key, event.shiftKey);
    if (!action) return;
    event.preventDefault();
    action();
  }

  actionOf(key, shift) {
    const half = Math.round(0.5 * this.recording.fps), turn = (around, over) => () => this.visitor.turn(around, over);
    const next_speed = up => () => this.setSpeed(up ? SPEEDS.find(speed => speed > this.speed + 1e-6) ?? 4
      : [...SPEEDS].reverse().find(speed => speed < this.speed - 1e-6) ?? 0.1);
    const actions = {
      " ": () => this.setPlaying(!this.playing),
      arrowleft: () => this.step(shift ? -half : -1), arrowright: () => this.step(shift ? half : 1),
      arrowup: next_speed(true), arrowdown: next_speed(false),
      home: () => this.seekByHand(0), end: () => this.seekByHand(this.recording.duration),
      a: turn(-KEY_TURN, 0), d: turn(KEY_TURN, 0), w: turn(0, KEY_TURN), s: turn(0, -KEY_TURN),
      "+": () => this.visitor.zoom(1 / KEY_ZOOM), "=": () => this.visitor.zoom(1 / KEY_ZOOM), "-": () => this.visitor.zoom(KEY_ZOOM),
      c: () => this.chooseCamera(this.recording.cameras[(this.camera + (this.free ? 0 : 1)) % this.recording.cameras.length].name),
      n: () => this.selectNext(), f: () => this.toggleFullscreen(),
      escape: () => (document.querySelector(".menu[open]") ? (document.querySelector(".menu[open]").open = false) : this.select(null)),
      "?": () => { byId("help").open = !byId("help").open; },
    };
    const overlay = OVERLAYS[Number(key) - 1];
    if (overlay) return () => this.setOverlay(overlay.name, !this.chosen.has(overlay.name));
    return actions[key.toLowerCase()];
  }
}

async function start() {
  try {
    const recording = new Recording(await unpacked(byId("data").textContent));
    byId("data").remove();
    globalThis.carom = new Player(recording);
  } catch (problem) {
    byId("failure").textContent = `This page cannot be played here: ${problem.message}`;
    byId("failure").hidden = false;
    throw problem;
  }
}

globalThis.caromStarted = start();
