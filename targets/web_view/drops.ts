// Files that are dropped on the page become pictures of a texture.

import type { Panel } from "./panel.js";

/** `tell` shows a sentence where it is not clear which texture is meant. */
export function takeDrops(panel: () => Panel | null, tell: (text: string) => void): void {
  const carriesFile = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  const { body } = document;

  document.addEventListener("dragover", (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault();
    body.classList.add("dropping");
  });
  for (const name of ["dragleave", "drop"] as const) {
    document.addEventListener(name, (event) => {
      // Between two elements of the page, one is left and the other entered.
      if (name === "drop" || !event.relatedTarget) body.classList.remove("dropping");
    });
  }
  document.addEventListener("drop", (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    const known = panel();
    if (!file || !known) return;
    const names = known.textures;
    const own = (event.target as Element).closest<HTMLElement>("[data-kind=texture]")?.dataset.name;
    const name = own ?? (names.length === 1 ? names[0] : undefined);
    if (name !== undefined) void known.give(name, file);
    else if (names.length) tell(`Drop it on one of these: ${names.join(", ")}.`);
    else tell("Nothing here has a texture.");
  });
}
