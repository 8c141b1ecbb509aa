// Loads the documents of `burnish view` from the server, and listens to changes of the file.

/**
 * @import { FramePackage, Value } from "../web_host/host.js"
 * @import { OrbitRow } from "./orbit.js"
 */

/**
 * A value that a person can set: a row of `controls.py`. Names that begin with two hyphens are
 * options of the command line, and all others parameters.
 * @typedef {object} Control
 * @property {string} name
 * @property {string} section
 * @property {string | null} inherited_from The base, mixin or pass that declares it; null if its
 *   section does.
 * @property {string} doc
 * @property {"number" | "angle" | "vector" | "direction" | "matrix" | "color" | "checkbox"
 *   | "checkboxes" | "texture" | "choice" | "member"} kind
 * @property {string} type
 * @property {boolean} is_light
 * @property {{ count: string | null, index: number } | null} element Of a light in an array: its
 *   number, and the parameter that says how many shine.
 * @property {Value} value
 * @property {number} [lanes]
 * @property {number} [columns]
 * @property {boolean} [whole]
 * @property {[number, number] | null} [range]
 * @property {string[]} [choices] The words of a choice; the members of an enumeration, by their
 *   numbers, which are its values.
 * @property {boolean} [is_given] Of a texture: true if it is not the default, which `value`
 *   names.
 * @property {{ file: string, is_float: boolean, is_srgb: boolean } | null} picture The picture
 *   that the page has given it.
 * @property {boolean} [is_timed] True for a number that changes from frame to frame, such as a
 *   time.
 */

/**
 * The choice of what the page draws.
 * @typedef {object} Choice
 * @property {string | null} file One of a folder's files.
 * @property {string | null} subject
 * @property {string | null} rig
 * @property {string | null} pass
 * @property {string | null} mesh
 * @property {string | null} [output] The output that is shown; the server need not know.
 */

/**
 * The members that every document has.
 * @typedef {object} Head
 * @property {string} version
 * @property {string} file
 * @property {{ name: string, kind: "frame" | "material" | "kernel" }[]} subjects
 * @property {string[]} rigs
 * @property {string[]} passes
 * @property {string[]} meshes
 * @property {number} most_bytes The largest size of a picture's file.
 */

/**
 * A document with the errors of the file, as the compiler shows them on a terminal.
 * @typedef {Head & { error: string }} Broken
 */

/**
 * A document that the page can draw.
 * @typedef {Head & {
 *   error?: undefined,
 *   chosen: Choice,
 *   doc: string,
 *   controls: Control[],
 *   orbit: OrbitRow,
 *   package: FramePackage,
 *   development: { package: FramePackage, tones: string[] },
 * }} Drawable
 */

/** @typedef {Broken | Drawable} Document */

/**
 * The document of a choice; `further` are names and values of the query besides.
 * @param {Choice} choice
 * @param {string} profile
 * @param {[string, string][]} further
 * @returns {Promise<Document>}
 */
export async function fetchDocument(choice, profile, further) {
  const asked = new URLSearchParams([["profile", profile], ...further]);
  for (const [name, value] of Object.entries(choice)) if (value) asked.set(name, value);
  const answer = await fetch(`/document?${asked}`);
  if (!answer.ok) throw new Error(`The server answered: ${answer.status} ${await answer.text()}`);
  return /** @type {Document} */ (await answer.json());
}

/**
 * Files of a folder under one heading.
 * @typedef {object} Group
 * @property {string} title
 * @property {{ name: string, what: string, subjects: string[] }[]} files
 */

/**
 * The files of the folder that is shown; none, if it is a single file.
 * @returns {Promise<Group[]>}
 */
export async function fetchFiles() {
  const answer = await fetch("/files");
  return answer.ok ? /** @type {Group[]} */ (await answer.json()) : [];
}

/**
 * Calls `changed` with a file and its version, now and after each change; `connected` is told
 * whether the server is there.
 * @param {(file: string, version: string) => void} changed
 * @param {(is: boolean) => void} connected
 */
export function listen(changed, connected) {
  const source = new EventSource("/changes");
  source.onopen = () => connected(true);
  source.onerror = () => connected(false);
  source.onmessage = (event) => {
    /** @type {{ file: string, version: string }} */
    const { file, version } = JSON.parse(event.data);
    changed(file, version);
  };
}
