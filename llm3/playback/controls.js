// Plays the replay that this page holds, for keyboards, screen readers, and the page around it.
//
// viser's player has the buttons but no names for them, and one timeline. This gives them names, starts at a standstill,
// adds a choice of chapters, stops at the end of each, and obeys messages: {chapter: its number from 0}, also one that
// comes before the player is there, as browsers let a frame wait that nobody sees yet.
"use strict";

const NEARLY = 0.1;  // seconds, to which the player rounds what is sought
let current = 0;  // the chapter
let ready = null;  // the controls, once there are any

function player() {
  const time = document.querySelector("input[inputmode=decimal]");
  const bar = time && time.closest(".mantine-Paper-root");
  const button = bar && bar.querySelector("button");
  const slider = bar && bar.querySelector("[role=slider]");
  const exact = slider && bar.querySelector("input[type=hidden]");
  const canvas = document.querySelector("canvas[data-engine]");
  return canvas && button && exact ? { time, bar, button, slider, exact, canvas } : null;
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

function show(controls, number) {
  current = number;
  play(controls, false);
  seek(controls, CHAPTERS[number].time);
  tell(controls);
}

function tell({ choice, note }) {
  choice.value = String(current);
  note.textContent = CHAPTERS[current].note;
}

function name({ button, ...controls }) {
  const label = isPlaying({ button }) ? "Pause" : "Play";
  if (button.getAttribute("aria-label") === label) return;
  button.setAttribute("aria-label", label);
  button.title = label;
  // At the end of a chapter it is the chapter that begins again.
  if (label === "Pause" && Number(controls.exact.value) > CHAPTERS[current].end - NEARLY) {
    play({ button }, false);
    seek(controls, CHAPTERS[current].time);
    setTimeout(() => play({ button }, true), 100);
  }
}

function chapters() {
  const row = document.createElement("div");
  row.className = "chapters";
  row.innerHTML = '<label>Chapter <select></select></label><p role="status"></p>';
  const choice = row.querySelector("select");
  CHAPTERS.forEach(({ title }, number) => choice.add(new Option(title, String(number))));
  row.hidden = CHAPTERS.length === 1;
  return { row, choice, note: row.querySelector("p") };
}

function watch(controls) {
  const now = Number(controls.exact.value);
  if (isPlaying(controls)) {
    if (now >= CHAPTERS[current].end) {
      play(controls, false);
      seek(controls, CHAPTERS[current].end);
    }
  } else {  // whoever drags the slider may be in another one
    const there = CHAPTERS.findLastIndex(({ time }) => time <= now + NEARLY);
    if (there >= 0 && there !== current && now > CHAPTERS[there].time + NEARLY) {
      current = there;
      tell(controls);
    }
  }
}

function begin(controls) {
  const heading = document.createElement("h1");
  heading.textContent = document.title;
  document.getElementById("root").setAttribute("role", "main");
  controls.bar.before(heading, controls.row);
  controls.choice.addEventListener("change", () => show(controls, Number(controls.choice.value)));
  controls.time.setAttribute("aria-label", "Time in seconds");
  controls.slider.setAttribute("aria-label", "Time");
  const speed = controls.bar.querySelector("[role=combobox]");
  if (speed) speed.setAttribute("aria-label", "Speed");
  for (const button of document.querySelectorAll("[role=alert] button:not([aria-label])")) {
    button.setAttribute("aria-label", "Close");
  }
  controls.canvas.setAttribute("role", "img");
  controls.canvas.setAttribute("aria-label", document.title);
  show(controls, current);
  name(controls);
  new MutationObserver(() => name(controls)).observe(controls.button, { childList: true, subtree: true });
  setInterval(() => watch(controls), 50);  // not with every frame: a page that stands still should cost nothing
  document.documentElement.dataset.ready = "yes";
}

window.addEventListener("message", ({ data }) => {
  if (!data || !CHAPTERS[data.chapter]) return;
  current = data.chapter;
  if (ready) show(ready, current);
});

const waiting = setInterval(() => {
  const found = player();
  if (!found) return;
  clearInterval(waiting);
  ready = { ...found, ...chapters() };
  begin(ready);
}, 50);
