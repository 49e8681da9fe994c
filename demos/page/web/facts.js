// What the page tells in words: about the scene, its source, a body's card, the modes' legend.

import { lengthText } from "./overlays.js";

/** An element with text or children. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "swatch") made.style.setProperty("--swatch", value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

export function energyText(joule) {
  const size = Math.abs(joule);
  if (size === 0) return "0 J";
  if (size < 1e-3) return `${(1e6 * joule).toPrecision(3)} \u00b5J`;
  if (size < 1) return `${(1e3 * joule).toPrecision(3)} mJ`;
  if (size < 1e4) return `${joule.toPrecision(3)} J`;
  return size < 1e7 ? `${(1e-3 * joule).toPrecision(4)} kJ` : `${(1e-6 * joule).toPrecision(4)} MJ`;
}

const massText = kg => (kg < 0.1 ? `${(1e3 * kg).toPrecision(3)} g`
  : kg < 1e4 ? `${kg.toPrecision(3)} kg` : `${(1e-3 * kg).toPrecision(4)} t`);
const speedText = v => (v === 0 ? "0 m/s" : v < 0.01 ? `${(1e3 * v).toPrecision(2)} mm/s` : `${v.toPrecision(3)} m/s`);
const spinText = w => (w < 1e-3 ? "0 rad/s" : `${w.toPrecision(3)} rad/s`);

/** Rows of name and value about a body in a frame. */
export function bodyFacts(recording, number, frame) {
  const body = recording.bodies[number], motion = recording.motionOf(number, frame);
  const mode = recording.facts.modes[motion.mode];
  const rows = [["does", [element("i", { swatch: mode.color }), mode.name]]];
  if (!body.static) rows.push(["speed", [speedText(motion.speed)]], ["spin", [spinText(motion.spin)]]);
  if (body.mass) rows.push(["kinetic energy", [energyText(motion.kinetic)]], ["height", [lengthText(motion.position[2])]],
                           ["mass", [massText(body.mass)]]);
  const near = recording.contacts.distancesOf(frame).find(({ a, b }) => a === number || b === number);
  if (near) {
    const other = recording.bodies[near.a === number ? near.b : near.a].name;
    rows.push(["nearest", [other]], ["gap", [lengthText(near.distance)]]);
  }
  if (body.material) rows.push(["material", [body.material]]);
  return rows;
}

export function modeCounts(recording, frame) {
  const counts = recording.facts.modes.map(() => 0);
  recording.bodies.forEach((body, i) => { if (!body.static) ++counts[recording.modes[i][frame]]; });
  return counts;
}

/** A scene's text with comments, keys, texts and numbers in colours of their own. */
function colored(source) {
  const pieces = /(\/\/[^\n]*|\/\*[\s\S]*?\*\/)|("(?:[^"\\\n]|\\.)*"(?=\s*:))|("(?:[^"\\\n]|\\.)*")|(-?\b\d+(?:\.\d+)?(?:[eE][-+]?\d+)?\b|\b(?:true|false|null)\b)/g;
  const kinds = ["c", "k", "s", "n"], out = document.createDocumentFragment();
  let last = 0;
  for (const found of source.matchAll(pieces)) {
    out.append(source.slice(last, found.index));
    out.append(element("span", { class: kinds[found.slice(1).findIndex(part => part !== undefined)] }, found[0]));
    last = found.index + found[0].length;
  }
  out.append(source.slice(last));
  return out;
}

function codeBlock(text, shown) {
  const copy = element("button", { class: "copy", type: "button" }, "copy");
  copy.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text);
      copy.textContent = "copied";
    } catch {
      getSelection().selectAllChildren(copy.nextElementSibling);
    }
    setTimeout(() => { copy.textContent = "copy"; }, 1500);
  });
  return element("div", { class: "code" }, copy, element("pre", { tabindex: "0" }, shown));
}

/** The part of the page below the picture. */
export function writeAbout(recording, about) {
  const { facts } = recording, { scene } = facts;
  const moving = recording.bodies.filter(body => !body.static).length;
  about.append(element("h2", {}, "About this scene"));
  if (scene.lookFor) about.append(element("p", { class: "look" }, scene.lookFor));
  const list = element("dl", { class: "facts" });
  for (const [name, value] of [["bodies that move", moving], ["fixed", recording.bodies.length - moving],
                               ["length", `${Number((facts.frames / facts.fps).toFixed(2))} s`],
                               ["recorded", `${facts.frames} frames at ${Number(facts.fps.toFixed(2))} a second`],
                               ["simulated at", `${scene.rate} steps a second`],
                               ["positions within", lengthText(0.87 * facts.quanta.length)], ["by", facts.program]])
    list.append(element("div", {}, element("dt", {}, name), element("dd", {}, String(value))));
  about.append(list, element("h3", {}, "The command that makes this page"), codeBlock(scene.command, scene.command));
  if (scene.source)
    about.append(element("h3", {}, `The scene: ${scene.file}`), codeBlock(scene.source, colored(scene.source)));
}

/** The kinetic energy of all bodies over time, under the timeline. */
export function drawEnergy(canvas, recording, share) {
  const pixels = globalThis.devicePixelRatio ?? 1, context = canvas.getContext("2d");
  const width = canvas.width = Math.max(1, Math.round(canvas.clientWidth * pixels));
  const height = canvas.height = Math.max(1, Math.round(canvas.clientHeight * pixels));
  const most = Math.max(...recording.energies, 1e-300), style = getComputedStyle(canvas);
  const last = Math.max(1, recording.frames - 1);
  const shape = new Path2D();
  shape.moveTo(0, height);
  for (let x = 0; x <= width; ++x) {
    const energy = recording.energies[Math.min(last, Math.round(x / width * last))] ?? 0;
    shape.lineTo(x, height - 1.5 * pixels - (height - 6 * pixels) * Math.sqrt(energy / most));
  }
  shape.lineTo(width, height);
  shape.closePath();
  context.fillStyle = style.getPropertyValue("--hover");
  context.fillRect(0, 0, width, height);
  context.fillStyle = style.getPropertyValue("--line");
  context.fill(shape);
  context.save();
  context.beginPath();
  context.rect(0, 0, share * width, height);
  context.clip();
  context.fillStyle = style.getPropertyValue("--accent-soft");
  context.fillRect(0, 0, width, height);
  context.fillStyle = style.getPropertyValue("--accent");
  context.globalAlpha = 0.75;
  context.fill(shape);
  context.restore();
}
