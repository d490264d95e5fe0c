// Buttons that copy commands, and pictures that open large. Without it the report can be read too.
"use strict";

// Buttons of a folded table are made when it opens.
function addButtons(part) {
  for (const code of part.querySelectorAll("code.command")) {
    if (code.nextElementSibling?.matches("button") || code.closest("details:not([open])")) continue;
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "copy";
    button.setAttribute("aria-label", "copy " + code.textContent);
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(code.textContent);
      button.textContent = "copied";
    });
    code.after(button);
  }
}
addButtons(document);
for (const details of document.querySelectorAll("details"))
  details.addEventListener("toggle", () => details.open && addButtons(details));

const dialog = document.createElement("dialog");
const large = document.createElement("img");
const close = document.createElement("button");
close.textContent = "close";
close.addEventListener("click", () => dialog.close());
dialog.append(large, close);
dialog.addEventListener("click", (event) => event.target === large && dialog.close());
document.body.append(dialog);
document.addEventListener("click", (event) => {
  const picture = event.target.closest("a.picture");
  if (!picture || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  large.src = picture.href;
  large.alt = picture.firstElementChild.alt;
  dialog.setAttribute("aria-label", large.alt);
  dialog.showModal();
});
