// Plays the replay that this page holds, for keyboards, screen readers, and the page around it.
//
// viser's player has the buttons but no names for them. This gives them names, starts at a standstill, adds a button for
// each chapter, and obeys messages: {chapter: its number from 0}, also one that comes before the player is there, as
// browsers let a frame wait that nobody sees yet.
"use strict";

function player() {
  const time = document.querySelector("input[inputmode=decimal]");
  const bar = time && time.closest(".mantine-Paper-root");
  const button = bar && bar.querySelector("button");
  const slider = bar && bar.querySelector("[role=slider]");
  const canvas = document.querySelector("canvas[data-engine]");
  return canvas && button && slider ? { time, bar, button, slider, canvas } : null;
}

function isPlaying({ button }) {
  return button.querySelector(".tabler-icon-player-pause-filled") !== null;
}

function play(controls, wanted) {
  if (isPlaying(controls) !== wanted) controls.button.click();
}

function seek({ time }, seconds) {
  const write = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set;
  write.call(time, String(seconds));  // React listens to the event, and asks the setter of the prototype
  time.dispatchEvent(new Event("input", { bubbles: true }));
  time.blur();
}

function show(controls, chapter) {
  play(controls, false);
  seek(controls, chapter.time);
}

function name(controls) {
  const label = isPlaying(controls) ? "Pause" : "Play";
  if (controls.button.getAttribute("aria-label") === label) return;
  controls.button.setAttribute("aria-label", label);
  controls.button.title = label;
}

function addChapters(controls) {
  const list = document.createElement("nav");
  list.className = "chapters";
  list.setAttribute("aria-label", "Chapters");
  for (const chapter of CHAPTERS) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = chapter.title;
    button.addEventListener("click", () => show(controls, chapter));
    list.append(button);
  }
  controls.bar.before(list);
}

function begin(controls) {
  show(controls, wanted);
  controls.time.setAttribute("aria-label", "Time in seconds");
  controls.slider.setAttribute("aria-label", "Time");
  const speed = controls.bar.querySelector("[role=combobox]");
  if (speed) speed.setAttribute("aria-label", "Speed");
  controls.canvas.setAttribute("role", "img");
  controls.canvas.setAttribute("aria-label", document.title);
  name(controls);
  new MutationObserver(() => name(controls)).observe(controls.button, { childList: true, subtree: true });
  if (CHAPTERS.length > 1) addChapters(controls);
  document.documentElement.dataset.ready = "yes";
}

let wanted = CHAPTERS[0];
let ready = null;  // the controls, once there are any

window.addEventListener("message", ({ data }) => {
  if (!data || !CHAPTERS[data.chapter]) return;
  wanted = CHAPTERS[data.chapter];
  if (ready) show(ready, wanted);
});

const waiting = setInterval(() => {
  ready = player();
  if (!ready) return;
  clearInterval(waiting);
  begin(ready);
}, 50);
