// Lets the buttons beside the attempts turn the replay to what they are about.
"use strict";

const player = document.getElementById("player");
for (const button of document.querySelectorAll("button[data-chapter]")) {
  button.addEventListener("click", () => {
    player.contentWindow.postMessage({ chapter: Number(button.dataset.chapter) }, "*");
    player.scrollIntoView({ block: "center" });
    player.focus();
  });
}
