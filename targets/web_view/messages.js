// Shows the compiler's messages: text with the codes by which terminals set colours.

import { make } from "./elements.js";

/** The class of each code that diagnostics have. @type {Record<string, string>} */
const CLASSES = {
  "1": "strong",
  "1;31": "error",
  "1;33": "warning",
  "1;36": "note",
  "1;34": "gutter",
};

/**
 * The pieces of a text, each with its class; no class for plain text.
 * @param {string} text
 * @returns {{ text: string, name: string }[]}
 */
export function pieces(text) {
  /** @type {{ text: string, name: string }[]} */
  const found = [];
  let name = "";
  text.split(/\x1b\[([\d;]*)m/).forEach((piece, index) => {
    if (index % 2) name = CLASSES[piece] ?? "";
    else if (piece) found.push({ text: piece, name });
  });
  return found;
}

/**
 * @param {HTMLElement} element
 * @param {string} text
 */
export function showIn(element, text) {
  element.replaceChildren(
    ...pieces(text).map((piece) =>
      piece.name ? make("span", { class: piece.name }, piece.text) : piece.text,
    ),
  );
}
