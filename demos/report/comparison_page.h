#pragma once
// The page of a comparison report around its data: style, elements and script, all inside the one file. The
// data come between kPageTop and kPageBottom: a script element "facts", and "images-N" for pairs whose images
// are embedded. Tested with comparison_report.cpp, and in a browser by
// tests/demos/report/report_browser_test.cpp.

namespace carom::demos {

inline constexpr char kPageTop[] = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy"
  content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>carom compare</title>
<style>
:root { --paper: #faf9f7; --panel: #ffffff; --ink: #1c1b19; --soft: #6d6a64; --line: #e3e0da; --hover: #f1eee8;
  --bad: #b3391b; --bad-soft: #f7e3dc; --good: #2b7a43; --good-soft: #e0f0e4; --focus: #1f6feb; --stage: #d9d6d0; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #161614; --panel: #1e1e1b; --ink: #ecebe7; --soft: #a09d95; --line: #34332f; --hover: #292824;
    --bad: #ff8a65; --bad-soft: #44251b; --good: #7ccf94; --good-soft: #1d3525; --focus: #79b0ff; --stage: #0c0c0b; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif;
  font-variant-numeric: tabular-nums; }
header { padding: 28px 32px 20px; border-bottom: 1px solid var(--line); }
.brand { margin: 0 0 4px; color: var(--soft); font-size: 13px; letter-spacing: .02em; }
h1 { margin: 0; font-size: 30px; line-height: 1.2; font-weight: 650; letter-spacing: -.02em; }
h1.bad { color: var(--bad); } h1.good { color: var(--good); }
.paths { display: flex; flex-wrap: wrap; gap: 4px 28px; margin: 12px 0 0; color: var(--soft); font-size: 13px; }
.paths dt { display: inline; } .paths dd { display: inline; margin: 0 0 0 6px; color: var(--ink); }
code, .name { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .93em; overflow-wrap: anywhere; }
main { display: grid; grid-template-columns: minmax(260px, 340px) minmax(0, 1fr); }
nav { border-right: 1px solid var(--line); min-height: 70vh; }
.filter { display: flex; align-items: center; gap: 8px; padding: 12px 20px; color: var(--soft); font-size: 13px;
  border-bottom: 1px solid var(--line); cursor: pointer; }
.filter[hidden] { display: none; }
#list { list-style: none; margin: 0; padding: 8px; max-height: calc(100vh - 60px); overflow-y: auto; }
#list button { display: block; width: 100%; padding: 9px 12px; border: 0; border-radius: 8px; background: none;
  color: inherit; font: inherit; text-align: left; cursor: pointer; }
#list button:hover { background: var(--hover); }
#list button[aria-current=true] { background: var(--panel); box-shadow: 0 0 0 1px var(--line); }
.row { display: flex; justify-content: space-between; align-items: baseline; gap: 10px; }
.tag { flex: none; padding: 0 8px; border-radius: 99px; background: var(--bad-soft); color: var(--bad);
  font-size: 12px; white-space: nowrap; }
.tag.pass { background: var(--good-soft); color: var(--good); }
.brief { color: var(--soft); font-size: 12.5px; }
.bar { height: 3px; margin-top: 5px; border-radius: 2px; background: var(--line); overflow: hidden; }
.bar i { display: block; height: 100%; background: var(--bad); }
#viewer { padding: 20px 32px 40px; min-width: 0; }
#viewer h2 { margin: 0 0 2px; font-size: 18px; font-weight: 600; }
#about { margin: 0 0 14px; color: var(--soft); }
#about strong { color: var(--ink); font-weight: 600; }
.tools { display: flex; flex-wrap: wrap; gap: 10px; align-items: center; margin-bottom: 12px; }
.tabs { display: inline-flex; padding: 3px; gap: 2px; border: 1px solid var(--line); border-radius: 10px;
  background: var(--panel); }
.tools button { padding: 5px 13px; border: 0; border-radius: 7px; background: none; color: inherit; font: inherit;
  font-size: 14px; cursor: pointer; }
.tools button:hover:not(:disabled) { background: var(--hover); }
.tools button:disabled { color: var(--soft); opacity: .55; cursor: default; }
.tools button[aria-pressed=true], .tools [role=tab][aria-selected=true] { background: var(--ink); color: var(--paper); }
.tools > button { border: 1px solid var(--line); background: var(--panel); }
button:focus-visible, #stage:focus-visible, .filter:focus-within { outline: 2px solid var(--focus);
  outline-offset: 2px; }
#stage { position: relative; display: grid; margin: 0; max-width: 100%; touch-action: none; user-select: none; }
.pane { grid-area: 1 / 1; position: relative; overflow: hidden; background: var(--stage); border-radius: 6px; }
.pane[hidden] { display: none; }
.pane img { display: block; width: 100%; height: 100%; object-fit: contain; transform-origin: 0 0; }
.pane img.over { position: absolute; inset: 0; pointer-events: none; } .pane img.over[hidden] { display: none; }
.pane img.crisp { image-rendering: pixelated; }
.label { position: absolute; left: 10px; top: 10px; padding: 1px 9px; border-radius: 99px; font-size: 12px;
  background: rgb(20 20 18 / .78); color: #fff; }
#stage[data-view=slider] .pane[data-of=actual] .label { left: auto; right: 10px; }
.mark { position: absolute; border: 1.5px solid #ffb000; box-shadow: 0 0 0 1px rgb(0 0 0 / .55); pointer-events: none; }
.mark[hidden] { display: none; }
#stage[data-view=swap] { cursor: pointer; } #stage[data-view=slider] { cursor: ew-resize; }
#stage[data-view=side] { grid-template-columns: repeat(auto-fit, minmax(220px, 1fr)); gap: 10px; }
#stage[data-view=side] .pane { grid-area: auto; }
#split { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #fff;
  box-shadow: 0 0 0 1px rgb(0 0 0 / .4); pointer-events: none; }
#split::after { content: "\2194"; position: absolute; top: 50%; left: 50%; transform: translate(-50%, -50%);
  width: 30px; height: 30px; border-radius: 50%; background: #fff; color: #1c1b19; text-align: center;
  line-height: 30px; box-shadow: 0 1px 4px rgb(0 0 0 / .4); }
#split[hidden] { display: none; }
#cause { margin: 0 0 14px; padding: 10px 14px; background: var(--panel); border: 1px solid var(--line); border-radius: 8px; }
#cause[hidden] { display: none; }
#cause ul { margin: 4px 0 0; padding-left: 20px; color: var(--soft); font-size: 13px; }
#cause svg { display: block; width: 100%; max-width: 560px; margin-top: 8px; }
#cause .then { fill: none; stroke: var(--soft); stroke-width: 1.5; stroke-dasharray: 5 4; }
#cause .now { fill: none; stroke: #d55e00; stroke-width: 1.5; }
#cause text { font-size: 11px; fill: var(--ink); }
#list li { position: relative; } #list input { position: absolute; right: 10px; bottom: 10px; }
#accept { padding: 10px 14px; font-size: 13px; overflow-wrap: anywhere; } #accept[hidden] { display: none; }
#note { margin: 10px 0 0; color: var(--soft); font-size: 13px; }
.empty { padding: 60px 20px; text-align: center; color: var(--soft); border: 1px dashed var(--line);
  border-radius: 8px; }
.empty[hidden] { display: none; }
.keys { margin-top: 22px; padding-top: 12px; border-top: 1px solid var(--line); color: var(--soft); font-size: 13px; }
.keys span { display: inline-block; margin-right: 20px; }
kbd { padding: 0 5px; border: 1px solid var(--line); border-bottom-width: 2px; border-radius: 4px;
  background: var(--panel); color: var(--ink); font: 12px ui-monospace, "DejaVu Sans Mono", monospace; }
@media (max-width: 760px) {
  main { grid-template-columns: 1fr; } nav { border-right: 0; min-height: 0; } #list { max-height: 34vh; }
  header, #viewer { padding-left: 18px; padding-right: 18px; } h1 { font-size: 24px; } }
</style>
</head>
<body>
<header>
  <p class="brand">carom compare</p>
  <h1 id="verdict"></h1>
  <dl class="paths" id="paths"></dl>
</header>
<main>
  <nav aria-label="Pairs of images, worst first">
    <label class="filter" id="filter"><input type="checkbox" id="passing"> <span id="passing-text"></span></label>
    <ol id="list"></ol>
    <p id="accept" hidden>accept the chosen with<br><code id="accept-command"></code><br>
      take it back with<br><code id="undo-command"></code></p>
  </nav>
  <section id="viewer">
    <h2 class="name" id="name"></h2>
    <p id="about" aria-live="polite"></p>
    <div id="cause" hidden></div>
    <svg id="ink" width="0" height="0" aria-hidden="true"></svg>
    <div class="tools">
      <div class="tabs" role="tablist" aria-label="View">
        <button role="tab" data-view="swap">Swap</button>
        <button role="tab" data-view="slider">Slider</button>
        <button role="tab" data-view="difference">Difference</button>
        <button role="tab" data-view="side">Side by side</button>
      </div>
      <button id="zoom" aria-pressed="false">Worst tile</button>
      <button id="blink" aria-pressed="false">Blink</button>
    </div>
    <figure id="stage" tabindex="0" aria-label="The images of this pair">
      <div class="pane" data-of="golden"><img alt="golden" draggable="false"><img class="over" alt="" draggable="false" hidden><div class="mark"></div>
        <span class="label">golden</span></div>
      <div class="pane" data-of="actual"><img alt="actual" draggable="false"><img class="over" alt="" draggable="false" hidden><div class="mark"></div>
        <span class="label">actual</span></div>
      <div class="pane" data-of="difference"><img alt="difference" draggable="false"><img class="over" alt="" draggable="false" hidden><div class="mark"></div>
        <span class="label">difference</span></div>
      <div id="split" hidden></div>
    </figure>
    <div class="empty" id="empty" hidden></div>
    <p id="note"></p>
    <p class="keys">
      <span><kbd>&uarr;</kbd> <kbd>&darr;</kbd> pair</span>
      <span><kbd>1</kbd>&ndash;<kbd>4</kbd> view</span>
      <span><kbd>space</kbd> swap</span>
      <span><kbd>&larr;</kbd> <kbd>&rarr;</kbd> golden, actual or slider</span>
      <span><kbd>z</kbd> worst tile</span>
      <span><kbd>b</kbd> blink</span>
    </p>
  </section>
</main>
<noscript><p style="padding:32px">This report shows its images with a script of its own; please allow it.</p></noscript>
)html";

inline constexpr char kPageBottom[] = R"html(<script>
"use strict";
const byId = id => document.getElementById(id);
const facts = JSON.parse(byId("facts").textContent);
const pairs = facts.pairs;
const views = ["swap", "slider", "difference", "side"];
const kinds = ["golden", "actual", "difference"];
const state = { pair: 0, view: "swap", shown: "actual", split: 0.5, zoomed: false, blink: 0, passing: false };
const loaded = new Map();

function imagesOf(index) {
  if (!loaded.has(index)) {
    const block = byId("images-" + index);
    loaded.set(index, block ? JSON.parse(block.textContent) : {});
  }
  return loaded.get(index);
}
function element(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}
const grouped = n => String(n).replace(/\B(?=(\d{3})+$)/g, "\u2009");
const share = pair => pair.pixelsBeyond / (pair.width * pair.height);
const listed = () => pairs.map((_, i) => i).filter(i => state.passing || !pairs[i].passes || failing === 0);
const failing = pairs.filter(pair => !pair.passes).length;

function briefOf(pair) {
  if (pair.largest === undefined) return pair.detail;
  const pixels = grouped(pair.pixelsBeyond) + (pair.pixelsBeyond === 1 ? " pixel" : " pixels");
  return "largest " + pair.largest + "/" + pair.fullScale + ", " + pixels + " beyond";
}
function fillHeader() {
  const title = byId("verdict");
  title.textContent = facts.summary;
  title.className = failing ? "bad" : "good";
  document.title = (failing ? "\u2717 " : "\u2713 ") + facts.summary + " \u2013 carom compare";
  for (const [term, text] of facts.about) {
    const item = element("div");
    item.append(element("dt", "", term), element("dd", "", ""));
    item.lastChild.append(element("code", "", text));
    byId("paths").append(item);
  }
  byId("filter").hidden = failing === 0 || failing === pairs.length;
  byId("passing-text").textContent = "also show the " + grouped(pairs.length - failing) + " that pass";
}
const chosen = new Set();
const quoted = name => /^[A-Za-z0-9_.\/-]+$/.test(name) ? name : "'" + name.replaceAll("'", "'\\''") + "'";
function fillAccept() {
  byId("accept").hidden = chosen.size === 0;
  const names = [...chosen].sort((a, b) => a - b).map(i => quoted(pairs[i].name));
  byId("accept-command").textContent = facts.accept + names.join(",");
  byId("undo-command").textContent = facts.undo;
}
function fillList() {
  byId("list").replaceChildren(...listed().map(i => {
    const pair = pairs[i], button = element("button"), row = element("div", "row"), item = element("li");
    row.append(element("span", "name", pair.name), element("span", pair.passes ? "tag pass" : "tag", pair.verdict));
    button.append(row, element("div", "brief", briefOf(pair)));
    if (!pair.passes && pair.largest !== undefined) {
      const bar = element("div", "bar"), fill = element("i");
      // From one pixel of a million to the whole image, by powers of ten.
      fill.style.width = Math.max(4, 100 * (1 + Math.log10(share(pair)) / 6)) + "%";
      bar.append(fill);
      button.append(bar);
    }
    button.dataset.pair = i;
    button.addEventListener("click", () => select(i));
    item.append(button);
    if (pair.acceptable && facts.accept) {
      const box = element("input");
      box.type = "checkbox";
      box.title = "accept " + pair.name;
      box.checked = chosen.has(i);
      box.addEventListener("change", () => { box.checked ? chosen.add(i) : chosen.delete(i); fillAccept(); });
      item.append(box);
    }
    return item;
  }));
}
// The paths of the bodies that moved, then and now, in the two directions in which they go farthest.
function pathsOf(moved) {
  const bodies = moved.filter(body => body.golden && body.golden.length);
  if (!bodies.length) return null;
  const points = list => Array.from({ length: list.length / 3 }, (_, i) => list.slice(3 * i, 3 * i + 3));
  const all = bodies.flatMap(body => points(body.golden).concat(points(body.actual)));
  const low = [0, 1, 2].map(k => Math.min(...all.map(p => p[k]))), high = [0, 1, 2].map(k => Math.max(...all.map(p => p[k])));
  const order = [0, 1, 2].sort((i, j) => (high[j] - low[j]) - (high[i] - low[i])).slice(0, 2).sort();
  const scale = 190 / Math.max(1e-6, (high[order[1]] - low[order[1]]), (high[order[0]] - low[order[0]]) / 2.4);
  const place = p => [20 + scale * (p[order[0]] - low[order[0]]), 205 - scale * (p[order[1]] - low[order[1]])];
  const svg = document.createElementNS(byId("ink").namespaceURI, "svg");
  svg.setAttribute("viewBox", "0 0 560 230");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", "Paths then, dashed, and now");
  const add = (tag, attributes, text) => {
    const made = document.createElementNS(byId("ink").namespaceURI, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    if (text) made.textContent = text;
    svg.append(made);
  };
  for (const body of bodies) {
    for (const [className, list] of [["then", body.golden], ["now", body.actual]]) {
      const path = points(list).map(place);
      add("polyline", { class: className, points: path.map(p => p.map(x => x.toFixed(1)).join(",")).join(" ") });
      const end = path[path.length - 1];
      add("circle", { class: className, cx: end[0].toFixed(1), cy: end[1].toFixed(1), r: 3 });
    }
    const end = place(points(body.actual).pop());
    add("text", { x: (end[0] + 6).toFixed(1), y: (end[1] - 4).toFixed(1) }, body.name);
  }
  add("text", { x: 20, y: 225 }, "xyz"[order[0]] + " to the right, " + "xyz"[order[1]] + " upwards; dashed: golden");
  return svg;
}
function fillCause(cause) {
  const box = byId("cause");
  box.hidden = !cause;
  if (!cause) return;
  const list = element("ul");
  for (const change of cause.changes) list.append(element("li", "", change.part + ": " + change.text));
  for (const line of cause.lines) list.append(element("li", "", line));
  box.replaceChildren(element("strong", "", cause.headline), list);
  const paths = pathsOf(cause.moved);
  if (paths) box.append(paths);
}
function fillAbout(pair) {
  byId("name").textContent = pair.name;
  const about = byId("about");
  about.replaceChildren(element("strong", "", pair.verdict), document.createTextNode("  " + pair.detail.replaceAll("  ", " \u00b7 ")));
  fillCause(pair.cause);
  if (pair.variant) about.append(element("br"), document.createTextNode("nearest of several accepted: " + pair.variant));
  if (pair.update) about.append(element("br"), document.createTextNode("golden image " + pair.update));
}
function transformOf(pair) {
  if (!state.zoomed || !pair.tile) return "";
  const t = pair.tile;
  const scale = Math.max(1, Math.min(pair.width / (2 * t.width), pair.height / (2 * t.height)));
  const centre = [(t.x + t.width / 2) / pair.width, (t.y + t.height / 2) / pair.height];
  const offset = centre.map(c => 100 * Math.min(0, Math.max(1 - scale, 0.5 - scale * c)));
  return "translate(" + offset[0] + "%, " + offset[1] + "%) scale(" + scale + ")";
}
function placeImage(image, pair, source) {
  if (image.getAttribute("src") !== source) image.src = source;
  image.style.transform = transformOf(pair);
  image.classList.toggle("crisp", state.zoomed || pair.width < 640);
}
function placePane(pane, pair, source, many) {
  const mark = pane.querySelector(".mark"), over = pane.querySelector(".over"), mask = imagesOf(state.pair).mask;
  placeImage(pane.querySelector("img"), pair, source);
  over.hidden = !mask;
  if (mask) placeImage(over, pair, mask);
  pane.style.aspectRatio = pair.width + " / " + pair.height;
  pane.style.maxWidth = many ? "" : "calc(72vh * " + pair.width / pair.height + ")";
  mark.hidden = !pair.tile || state.zoomed || pair.passes;
  if (mark.hidden) return;
  mark.style.left = 100 * pair.tile.x / pair.width + "%";
  mark.style.top = 100 * pair.tile.y / pair.height + "%";
  mark.style.width = 100 * pair.tile.width / pair.width + "%";
  mark.style.height = 100 * pair.tile.height / pair.height + "%";
}
function visibleKinds(images) {
  const present = kinds.filter(kind => images[kind]);
  if (state.view === "side" || present.length < 2) return present;
  if (state.view === "difference") return images.difference ? ["difference"] : [];
  if (state.view === "slider") return ["golden", "actual"];
  return [state.shown];
}
function drawSplit() {
  const slides = byId("stage").dataset.view === "slider";
  byId("split").style.left = 100 * state.split + "%";
  byId("stage").querySelector("[data-of=actual]").style.clipPath =
    slides ? "inset(0 0 0 " + 100 * state.split + "%)" : "";
}
function draw() {
  const pair = pairs[state.pair];
  if (!pair) return;
  const images = imagesOf(state.pair);
  const present = kinds.filter(kind => images[kind]);
  const visible = visibleKinds(images);
  const stage = byId("stage");
  stage.dataset.view = present.length < 2 ? "single" : state.view;
  stage.dataset.shown = state.shown;
  stage.dataset.zoomed = state.zoomed;
  stage.style.maxWidth = stage.dataset.view === "side" ? "" : "calc(72vh * " + pair.width / pair.height + ")";
  for (const kind of kinds) {
    const pane = stage.querySelector("[data-of=" + kind + "]");
    pane.hidden = !visible.includes(kind);
    if (!pane.hidden) placePane(pane, pair, images[kind], state.view === "side");
  }
  stage.hidden = visible.length === 0;
  byId("split").hidden = stage.dataset.view !== "slider";
  drawSplit();
  for (const tab of document.querySelectorAll("[role=tab]")) {
    tab.setAttribute("aria-selected", tab.dataset.view === state.view);
    tab.disabled = present.length < 2 || (tab.dataset.view === "difference" && !images.difference);
  }
  byId("zoom").disabled = !pair.tile || present.length === 0;
  byId("zoom").setAttribute("aria-pressed", state.zoomed);
  byId("blink").disabled = present.length < 2;
  byId("blink").setAttribute("aria-pressed", state.blink !== 0);
  const empty = byId("empty");
  empty.hidden = visible.length !== 0;
  empty.textContent = pair.embedded ? "Images of different sizes have no difference image." :
    pair.verdict === "same" ? "Both images are the same." : pair.verdict === "unreadable" ?
    "No image can be shown." : "Not among the worst " + facts.embedded + " pairs, whose images this file holds.";
  const masked = images.masked === 1 ? " 1 pixel, striped, is not looked at." :
    images.masked ? " " + grouped(images.masked) + " pixels, striped, are not looked at." : "";
  byId("note").textContent = (images.note || "") + masked;
  for (const button of byId("list").querySelectorAll("button"))
    button.setAttribute("aria-current", Number(button.dataset.pair) === state.pair);
  try { history.replaceState(null, "", "#" + state.pair + "/" + state.view); } catch (refused) { /* not vital */ }
}
function select(index) {
  state.pair = index;
  state.shown = "actual";
  fillAbout(pairs[index]);
  draw();
  const current = byId("list").querySelector("[aria-current=true]");
  if (current) current.scrollIntoView({ block: "nearest" });
}
function show(view) {
  if (document.querySelector("[data-view=" + view + "][role=tab]").disabled) return;
  state.view = view;
  draw();
}
function swap(to) {
  const present = kinds.filter(kind => imagesOf(state.pair)[kind]);
  if (present.length < 2) return;
  state.view = "swap";
  state.shown = to || (state.shown === "actual" ? "golden" : "actual");
  draw();
}
function slide(to) {
  state.split = Math.min(1, Math.max(0, to));
  drawSplit();
}
function zoom() {
  if (byId("zoom").disabled) return;
  state.zoomed = !state.zoomed;
  draw();
}
function blink() {
  if (state.blink) {
    clearInterval(state.blink);
    state.blink = 0;
  } else if (!byId("blink").disabled) {
    state.blink = setInterval(() => swap(), 600);
  }
  draw();
}
function step(by) {
  const order = listed(), at = order.indexOf(state.pair) + by;
  if (at >= 0 && at < order.length) select(order[at]);
}
const onKey = {
  ArrowDown: () => step(1), j: () => step(1), ArrowUp: () => step(-1), k: () => step(-1),
  ArrowLeft: () => state.view === "slider" ? slide(state.split - 0.02) : swap("golden"),
  ArrowRight: () => state.view === "slider" ? slide(state.split + 0.02) : swap("actual"),
  " ": () => swap(), z: zoom, b: blink,
  1: () => show("swap"), 2: () => show("slider"), 3: () => show("difference"), 4: () => show("side") };
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || !onKey[event.key]) return;
  // Space presses the button or box that has the focus.
  if (event.key === " " && event.target.matches && event.target.matches("button, input")) return;
  event.preventDefault();
  onKey[event.key]();
});
const stage = byId("stage");
const follow = event => {
  const box = stage.getBoundingClientRect();
  slide((event.clientX - box.left) / box.width);
};
stage.addEventListener("pointerdown", event => {
  if (stage.dataset.view === "swap") swap();
  if (stage.dataset.view !== "slider") return;
  stage.setPointerCapture(event.pointerId);
  follow(event);
});
stage.addEventListener("pointermove", event => { if (stage.hasPointerCapture(event.pointerId)) follow(event); });
for (const tab of document.querySelectorAll("[role=tab]")) tab.addEventListener("click", () => show(tab.dataset.view));
byId("zoom").addEventListener("click", zoom);
byId("blink").addEventListener("click", blink);
byId("passing").addEventListener("change", event => {
  state.passing = event.target.checked;
  fillList();
  draw();
});
fillHeader();
const wanted = location.hash.slice(1).split("/");
if (views.includes(wanted[1])) state.view = wanted[1];
fillList();
if (pairs.length) select(pairs[Number(wanted[0])] ? Number(wanted[0]) : 0);
</script>
</body>
</html>
)html";

}  // namespace carom::demos
