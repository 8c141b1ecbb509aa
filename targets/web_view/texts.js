// Shows the texts of the shaders that draw the picture.

import { element, make } from "./elements.js";

/** @import { FramePackage } from "../web_host/host.js" */

const dialog = element("texts", HTMLDialogElement);
const chosen = element("text-of", HTMLSelectElement);
const shown = element("text", HTMLPreElement);

/** Each text by the names of its shader and stage. @type {Map<string, string>} */
let texts = new Map();

chosen.addEventListener("change", show);
element("open-texts", HTMLButtonElement).addEventListener("click", () => {
  show();
  dialog.showModal();
});
element("copy-text", HTMLButtonElement).addEventListener("click", () => {
  void navigator.clipboard.writeText(shown.textContent ?? "");
});

/**
 * Take the texts of another package; an open dialog shows the new text.
 * @param {FramePackage} from
 */
export function showTextsOf(from) {
  texts = new Map(
    from.shaders.flatMap(({ reflection, texts: byProfile }) =>
      Object.values(byProfile).flatMap((stages) =>
        Object.entries(stages).map(([stage, { text }]) =>
          /** @type {const} */ ([`${reflection.material} · ${stage}`, text]),
        ),
      ),
    ),
  );
  const before = chosen.value;
  chosen.replaceChildren(...[...texts.keys()].map((name) => make("option", { value: name }, name)));
  // The fragment shader is the best first choice: it says most about a material.
  const first = [...texts.keys()].find((name) => name.endsWith("fragment")) ?? chosen.value;
  chosen.value = texts.has(before) ? before : first;
  if (dialog.open) show();
}

function show() {
  shown.textContent = texts.get(chosen.value) ?? "";
}
