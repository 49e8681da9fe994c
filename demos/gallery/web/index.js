"use strict";
// Finds scenes by words, holds the pictures still, copies commands.
const cards = [...document.querySelectorAll(".card")];
const search = document.getElementById("search"), still = document.getElementById("still");
const fold = text => text.toLowerCase().normalize("NFKD").replace(/[\u0300-\u036f]/g, "");
const words = new Map(cards.map(card => [card, fold(card.dataset.words)]));

function filter() {
  const wanted = fold(search.value).split(/\s+/).filter(Boolean);
  for (const card of cards) card.hidden = !wanted.every(word => words.get(card).includes(word));
  for (const section of document.querySelectorAll("section")) {
    const shown = section.querySelectorAll(".card:not([hidden])").length;
    section.hidden = shown === 0;
    const chip = document.querySelector(`#groups a[href="#${section.id}"]`);
    chip.hidden = shown === 0;
    chip.querySelector("span").textContent = shown;
  }
  document.getElementById("none").hidden = cards.some(card => !card.hidden);
}

function holdStill(held) {
  still.setAttribute("aria-pressed", String(held));
  for (const image of document.querySelectorAll(".picture img")) {
    image.dataset.moving ??= image.getAttribute("src");
    const wanted = held ? image.dataset.still : image.dataset.moving;
    if (image.getAttribute("src") !== wanted) image.src = wanted;
    // Where a visitor prefers less motion the still is the browser's choice; asking for motion is his own.
    const source = image.parentElement.querySelector("source");
    if (source && !held) source.remove();
  }
}

search.addEventListener("input", filter);
document.getElementById("clear").addEventListener("click", () => {
  search.value = "";
  filter();
  search.focus();
});
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
if (calm) still.setAttribute("aria-pressed", "true");
still.addEventListener("click", () => holdStill(still.getAttribute("aria-pressed") !== "true"));
addEventListener("keydown", event => {
  if (event.key !== "/" || event.target === search) return;
  event.preventDefault();
  search.focus();
});
for (const button of document.querySelectorAll(".command button"))
  button.addEventListener("click", async () => {
    const code = button.previousElementSibling;
    try {
      await navigator.clipboard.writeText(code.textContent);
      button.textContent = "copied";
    } catch {
      getSelection().selectAllChildren(code);
    }
    setTimeout(() => { button.textContent = "copy"; }, 1500);
  });
if (search.value) filter();
