// The pictures that a person gives textures: files go to the server, which names each by a word.

import { make } from "./elements.js";

/** @import { Control } from "./documents.js" */

/** The prefix of the word of a picture whose colours are sRGB. */
const SRGB = "srgb:";
/** The kinds of files that a browser offers to choose from. */
const KINDS = "image/png,image/jpeg,image/webp,image/*,.hdr,.exr,.ies";

/**
 * The members of a texture's control that this module reads.
 * @typedef {Control & { dimension: string, sample: string, intent: "color" | "data" }}
 *   TextureControl
 */

/** @type {(control: Control) => control is TextureControl} */
export const isTexture = (control) => control.kind === "texture";

/** The pictures of the subject that is shown; those of others are kept while the tab is open. */
export class Pictures {
  /** The words that the server is asked for, by texture. @type {Record<string, string>} */
  #asked = {};
  /** @type {string | null} */
  #key = null;
  /** The address of each picture's look, by its word. @type {Map<string, string>} */
  #looks = new Map();

  #changed;

  /**
   * `changed` is called when the server has to be asked again.
   * @param {() => void} changed
   */
  constructor(changed) {
    this.#changed = changed;
  }

  /**
   * The pictures to ask the server for, as names and values of a query.
   * @returns {[string, string][]}
   */
  get query() {
    return Object.entries(this.#asked).map(([name, word]) => [`picture.${name}`, word]);
  }

  /**
   * Change to the pictures of a subject, by its name. Returns true if they differ from those that
   * were asked for.
   * @param {string} key
   * @returns {boolean}
   */
  enter(key) {
    if (key === this.#key) return false;
    const before = JSON.stringify(this.#asked);
    this.#key = key;
    this.#asked = load(key);
    return JSON.stringify(this.#asked) !== before;
  }

  /**
   * Give a texture the picture of a file. Throws an error that says why that is impossible.
   * @param {TextureControl} control
   * @param {File} file
   * @param {number} mostBytes
   * @returns {Promise<void>}
   */
  async give(control, file, mostBytes) {
    if (file.size > mostBytes) {
      const [size, most] = [megabytes(file.size), megabytes(mostBytes)];
      throw new Error(`${file.name} has ${size}, and may have ${most}`);
    }
    const { dimension, sample, intent } = control;
    const query = new URLSearchParams({ name: file.name, dimension, sample });
    const answer = await fetch(`/picture?${query}`, { method: "POST", body: file });
    const said = await answer.text();
    if (!answer.ok) throw new Error(said);
    if (file.type.startsWith("image/")) this.#looks.set(said, URL.createObjectURL(file));
    const isSrgb = control.picture?.is_srgb ?? intent === "color";
    this.#ask(control.name, `${isSrgb ? SRGB : ""}${said}`);
  }

  /**
   * @param {string} name
   * @param {boolean} isSrgb
   */
  setSrgb(name, isSrgb) {
    this.#ask(name, `${isSrgb ? SRGB : ""}${this.#word(name)}`);
  }

  /** @param {string} name */
  drop(name) {
    if (!(name in this.#asked)) return;
    delete this.#asked[name];
    this.#keep();
  }

  /**
   * The address of an image of a texture's picture, if the page has one.
   * @param {string} name
   * @returns {string | null}
   */
  look(name) {
    return this.#looks.get(this.#word(name)) ?? null;
  }

  /**
   * @param {string} name
   * @returns {string}
   */
  #word(name) {
    return (this.#asked[name] ?? "").replace(SRGB, "");
  }

  /**
   * @param {string} name
   * @param {string} word
   */
  #ask(name, word) {
    this.#asked[name] = word;
    this.#keep();
  }

  #keep() {
    try {
      sessionStorage.setItem(storageKey(this.#key), JSON.stringify(this.#asked));
    } catch {
      // The browser keeps nothing: then pictures last as long as the page.
    }
    this.#changed();
  }
}

/**
 * The field of a texture: its picture, a button to choose another one, and the error of the last
 * choice.
 * @param {TextureControl} control
 * @param {string} label
 * @param {Pictures} pictures
 * @param {(file: File) => Promise<void>} give
 * @returns {HTMLElement}
 */
export function textureField(control, label, pictures, give) {
  const { name, picture } = control;
  const chooser = make("input", { type: "file", accept: KINDS, class: "hidden", tabindex: -1 });
  const button = make("button", { type: "button", "aria-describedby": label }, "Choose…");
  button.addEventListener("click", () => chooser.click());
  chooser.addEventListener("change", () => {
    const [file] = chooser.files ?? [];
    if (file) void give(file);
    chooser.value = "";
  });
  const given = control.is_given ? "A picture" : `All ${String(control.value)}`;
  const look = pictures.look(name);
  const shown = look ? make("img", { src: look, alt: "", class: "look" }) : "";
  const called = make("span", { class: "file" }, picture?.file ?? given);
  const line = make("div", { class: "pick" }, shown, called, button);
  const element = make("div", { class: "texture" }, line, chooser);
  if (picture && !picture.is_float && control.sample === "float") {
    const box = make("input", { type: "checkbox", checked: picture.is_srgb });
    box.addEventListener("change", () => pictures.setSrgb(name, box.checked));
    element.append(make("label", {}, box, " Its colours are sRGB"));
  }
  return element;
}

/** @type {(bytes: number) => string} */
const megabytes = (bytes) => `${Math.ceil(bytes / 2 ** 20)} MB`;
/** @type {(key: string | null) => string} */
const storageKey = (key) => `pictures of ${key ?? ""}`;

/**
 * @param {string} key
 * @returns {Record<string, string>}
 */
function load(key) {
  try {
    return JSON.parse(sessionStorage.getItem(storageKey(key)) ?? "{}");
  } catch {
    return {};
  }
}
