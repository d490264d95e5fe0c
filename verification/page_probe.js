// Put into copies of pages by pages_test.sh: tells the page of all frames what is wrong in this one.
"use strict";
addEventListener("load", async () => {
  const faults = [];
  const tell = () =>
    parent.postMessage(`${location.pathname.split("/").pop()} at ${innerWidth} px: ` + (faults.join("; ") || "sound"), "*");
  try {
    for (const details of document.querySelectorAll("details")) details.open = true;
    for (const image of document.querySelectorAll("img[src]")) {
      image.loading = "eager";
      await image.decode().catch(() => faults.push(`no picture ${image.getAttribute("src")}`));
    }
    const root = document.documentElement;
    if (root.scrollWidth > innerWidth) faults.push(`it scrolls sideways by ${root.scrollWidth - innerWidth} px`);
    const picture = document.querySelector("a.picture");
    if (picture) {
      picture.click();
      if (!document.querySelector("dialog[open]")) faults.push("a picture does not open large");
    }
  } catch (error) {
    faults.push(String(error));
  }
  tell();
});
