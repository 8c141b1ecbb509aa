// Files that are dropped on the page become pictures of a texture.

/** @import { Panel } from "./panel.js" */

/**
 * `tell` shows a sentence where it is not clear which texture is meant.
 * @param {() => Panel | null} panel
 * @param {(text: string) => void} tell
 */
export function takeDrops(panel, tell) {
  /** @type {(event: DragEvent) => boolean} */
  const carriesFile = (event) => event.dataTransfer?.types.includes("Files") ?? false;
  const { body } = document;

  document.addEventListener("dragover", (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault();
    body.classList.add("dropping");
  });
  for (const name of /** @type {const} */ (["dragleave", "drop"])) {
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
    const target = /** @type {Element} */ (event.target);
    /** @type {HTMLElement | null} */
    const texture = target.closest("[data-kind=texture]");
    const own = texture?.dataset.name;
    const name = own ?? (names.length === 1 ? names[0] : undefined);
    if (name !== undefined) void known.give(name, file);
    else if (names.length) tell(`Drop it on one of these: ${names.join(", ")}.`);
    else tell("Nothing here has a texture.");
  });
}
