// The controls beside the picture, in sections, with the values that a person has set.

import { present } from "../web_host/present.js";
import { make } from "./elements.js";
import { fieldOf } from "./fields.js";
import { isTexture, textureField } from "./pictures.js";

/**
 * @import { Value } from "../web_host/host.js"
 * @import { Control } from "./documents.js"
 * @import { Field } from "./fields.js"
 * @import { Pictures, TextureControl } from "./pictures.js"
 */

/**
 * A value that a person has set, and the type of its parameter then.
 * @typedef {object} Kept
 * @property {string} type
 * @property {Value} value
 */

/**
 * A control, as the page shows it.
 * @typedef {object} Row
 * @property {Control} control
 * @property {HTMLElement} element
 * @property {Field<Value>} field
 * @property {HTMLButtonElement} reset
 */

export class Panel {
  /** @type {Map<string, Row>} */
  #rows = new Map();
  /** @type {Record<string, Kept>} */
  #kept = {};
  #built = "";
  #subject = "";
  /** The largest size of a picture's file, in bytes. */
  #mostBytes = 0;
  /**
   * The numbers that run with the time, each with its exact value: fields show rounded ones.
   * @type {Map<string, number>}
   */
  #timed = new Map();

  #root;
  #changed;
  #animated;
  #pictures;

  /**
   * `changed` is called with every value that is set.
   * @param {HTMLElement} root
   * @param {(name: string, value: Value) => void} changed
   * @param {() => void} animated
   * @param {Pictures} pictures
   */
  constructor(root, changed, animated, pictures) {
    this.#root = root;
    this.#changed = changed;
    this.#animated = animated;
    this.#pictures = pictures;
  }

  /**
   * Show the controls of a subject; `subject` is the name under which its values are kept. Values
   * that a person has set stay if the control still takes them. Returns these values.
   * @param {string} subject
   * @param {Control[]} controls
   * @param {number} mostBytes
   * @returns {Map<string, Value>}
   */
  show(subject, controls, mostBytes) {
    this.#mostBytes = mostBytes;
    if (subject !== this.#subject) this.#kept = load(subject);
    this.#subject = subject;
    const known = JSON.stringify(controls);
    if (known !== this.#built) this.#build(controls);
    this.#built = known;
    /** @type {Map<string, Value>} */
    const values = new Map();
    for (const { control } of this.#rows.values()) {
      const kept = this.#kept[control.name];
      if (!kept || kept.type !== control.type) continue;
      values.set(control.name, within(kept.value, control.range));
    }
    for (const [name, row] of this.#rows) this.#refresh(row, values.get(name));
    return values;
  }

  /**
   * True if some number runs with the time.
   * @returns {boolean}
   */
  get runs() {
    return [...this.#timed.keys()].some((name) => this.#rows.has(name));
  }

  /**
   * Add seconds to the numbers that run with the time.
   * @param {number} seconds
   */
  advance(seconds) {
    for (const [name, before] of this.#timed) {
      const row = this.#rows.get(name);
      if (!row) continue;
      this.#timed.set(name, before + seconds);
      const given = row.control.whole ? Math.floor(before + seconds) : before + seconds;
      this.#kept[name] = { type: row.control.type, value: given };
      row.field.show(given);
      row.reset.hidden = false;
      this.#changed(name, given);
    }
  }

  resetAll() {
    for (const row of this.#rows.values()) {
      if (this.#kept[row.control.name] || row.control.picture) this.#reset(row);
    }
  }

  /**
   * The names of all textures.
   * @returns {string[]}
   */
  get textures() {
    return [...this.#rows.values()].filter(({ control }) => isTexture(control))
      .map(({ control }) => control.name);
  }

  /**
   * Give a texture the picture of a file; errors are shown in its row.
   * @param {string} name
   * @param {File} file
   * @returns {Promise<void>}
   */
  async give(name, file) {
    const row = this.#rows.get(name);
    if (!row || !isTexture(row.control)) return;
    row.element.querySelector(".wrong")?.remove();
    row.element.setAttribute("aria-busy", "true");
    try {
      await this.#pictures.give(row.control, file, this.#mostBytes);
    } catch (error) {
      const said = /** @type {Error} */ (error).message;
      row.element.append(make("p", { class: "wrong", role: "alert" }, said));
    } finally {
      row.element.removeAttribute("aria-busy");
    }
  }

  /**
   * The values that were set, as options of the command line.
   * @returns {string}
   */
  get options() {
    const values = Object.entries(this.#kept)
      .filter(([name]) => this.#rows.has(name))
      .map(([name, { value }]) => {
        const { choices } = present(this.#rows.get(name)).control;
        return [name, choices?.[Number(value)] ?? written(value)];
      });
    const pictures = [...this.#rows.values()].flatMap(({ control: { name, picture } }) =>
      picture ? [[name, `${picture.is_srgb ? "srgb:" : ""}${picture.file}`]] : [],
    );
    return [...values, ...pictures].map(([name, text]) =>
      name.startsWith("--") ? `${name}=${text}` : `--set '${name}=${text}'`,
    ).join(" ");
  }

  // --- building ----------------------------------------------------------------------------------

  /** @param {Control[]} controls */
  #build(controls) {
    /** @type {Map<string, boolean>} */
    const open = new Map();
    for (const each of this.#root.querySelectorAll("details")) {
      open.set(each.dataset.section ?? "", each.open);
    }
    /** @type {HTMLElement | null | undefined} */
    const inFocus = document.activeElement?.closest("[data-name]");
    const focused = inFocus?.dataset.name;
    this.#rows.clear();
    /** @type {Map<string, HTMLElement>} */
    const sections = new Map();
    /** What each section inherits, by the section and the declaration that it is from. */
    /** @type {Map<string, { section: HTMLElement, inside: HTMLElement }>} */
    const inherited = new Map();
    const haveOwn = new Set(
      controls.filter((each) => !each.inherited_from).map((each) => each.section),
    );
    for (const control of controls) {
      let section = sections.get(control.section);
      if (!section) {
        const begins = open.get(control.section) ?? !control.is_light;
        section = this.#section(control.section, begins);
        sections.set(control.section, section);
      }
      const from = control.inherited_from;
      let inside = section;
      if (from) {
        const key = `${control.section} ← ${from}`;
        // A section that has nothing of its own shows what it inherits.
        const begins = open.get(key) ?? !haveOwn.has(control.section);
        const known = inherited.get(key);
        inside = known?.inside ?? this.#section(key, begins, `from ${from}`);
        if (!known) inherited.set(key, { section, inside });
      }
      inside.append(this.#row(control).element);
    }
    for (const { section, inside } of inherited.values()) {
      section.append(present(inside.parentElement));
    }
    const nothing = make("p", { class: "nothing" }, "Nothing to set: no parameters are declared.");
    this.#root.replaceChildren(...(sections.size
      ? [...sections.values()].map((each) => present(each.parentElement)) : [nothing]));
    if (focused) {
      this.#rows.get(focused)?.element.querySelector("input")?.focus();
    }
  }

  /**
   * A section that can be folded; `key` tells it from all others when the panel is built again.
   * @param {string} key
   * @param {boolean} open
   * @param {string} title
   * @returns {HTMLElement}
   */
  #section(key, open, title = key) {
    const inside = make("div", { class: "controls" });
    const details = make("details", { open }, make("summary", {}, title), inside);
    details.dataset.section = key;
    return inside;
  }

  /**
   * @param {Control} control
   * @returns {Row}
   */
  #row(control) {
    const id = `label-${control.name}`;
    const label = make("span", { class: "name", id }, shortName(control));
    label.title = `${control.name} : ${control.type}`;
    const reset = make("button", {
      type: "button", class: "reset", title: "Back to the default",
      "aria-label": `${control.name}: back to the default`,
    }, "↺");
    /** @type {Field<Value>} */
    const field = isTexture(control)
      ? this.#textureField(control, id)
      : fieldOf(control, id, (value) => this.#set(row, value));
    const head = make("div", { class: "head" }, label);
    if (control.is_timed) head.append(this.#clock(control.name));
    head.append(reset);
    const element = make("div", { class: "control" }, head);
    if (control.doc) element.append(make("p", { class: "doc" }, control.doc));
    element.append(field.element);
    element.dataset.name = control.name;
    element.dataset.kind = control.kind;
    /** @type {Row} */
    const row = { control, element, field, reset };
    reset.addEventListener("click", () => this.#reset(row));
    this.#rows.set(control.name, row);
    return row;
  }

  /**
   * The field of a texture. It is made anew with the control, so `show` has nothing to do.
   * @param {TextureControl} control
   * @param {string} label
   * @returns {Field<Value>}
   */
  #textureField(control, label) {
    /** @type {(file: File) => Promise<void>} */
    const give = (file) => this.give(control.name, file);
    const element = textureField(control, label, this.#pictures, give);
    return { element, show: () => {} };
  }

  /**
   * A button that lets a number run with the time.
   * @param {string} name
   * @returns {HTMLElement}
   */
  #clock(name) {
    const button = make("button", {
      type: "button", class: "clock", title: "Let it run with the time, in seconds",
      "aria-label": `${name}: let it run with the time`,
      "aria-pressed": String(this.#timed.has(name)),
    }, "▶");
    button.addEventListener("click", () => {
      const row = present(this.#rows.get(name));
      if (!this.#timed.delete(name)) this.#timed.set(name, Number(this.#value(row) ?? 0));
      button.setAttribute("aria-pressed", String(this.#timed.has(name)));
      this.#animated();
    });
    return button;
  }

  // --- values ------------------------------------------------------------------------------------

  /**
   * @param {Row} row
   * @returns {Value}
   */
  #value(row) {
    return this.#kept[row.control.name]?.value ?? row.control.value;
  }

  /**
   * @param {Row} row
   * @param {Value} value
   */
  #set(row, value) {
    const { name, type } = row.control;
    this.#kept[name] = { type, value };
    row.reset.hidden = false;
    save(this.#subject, this.#kept);
    this.#changed(name, value);
    this.#hideUncounted();
  }

  /** @param {Row} row */
  #reset(row) {
    if (isTexture(row.control)) {
      this.#pictures.drop(row.control.name);
      return;
    }
    delete this.#kept[row.control.name];
    save(this.#subject, this.#kept);
    this.#refresh(row);
    this.#changed(row.control.name, row.control.value);
  }

  /**
   * @param {Row} row
   * @param {Value} [value]
   */
  #refresh(row, value) {
    row.field.show(value ?? row.control.value);
    row.reset.hidden = value === undefined && !row.control.picture;
    this.#hideUncounted();
  }

  /** Hide the lights of an array beyond the number that shine. */
  #hideUncounted() {
    for (const { control, element } of this.#rows.values()) {
      const { count, index } = control.element ?? { count: null, index: 0 };
      const counting = count ? this.#rows.get(count) : undefined;
      if (counting) element.hidden = index >= Number(this.#value(counting));
    }
  }
}

/**
 * The name without that of its section: `[2].place` of `lamps[2].place`.
 * @param {Control} control
 * @returns {string}
 */
function shortName(control) {
  const { section } = control;
  const name = control.name.replace(/^--/, "");
  return name.startsWith(section) && name !== section
    ? name.slice(section.length).replace(/^\./, "") : name;
}

/**
 * @param {Value} value
 * @param {Control["range"]} range
 * @returns {Value}
 */
function within(value, range) {
  if (!range) return value;
  if (Array.isArray(value)) return value.map((each) => within(each, range));
  return typeof value === "number" ? Math.min(Math.max(value, range[0]), range[1]) : value;
}

/**
 * A value as the command line takes it.
 * @param {Value} value
 * @returns {string}
 */
function written(value) {
  return Array.isArray(value) ? value.flat().join(",") : String(value);
}

/**
 * @param {string} key
 * @returns {Record<string, Kept>}
 */
function load(key) {
  try {
    return JSON.parse(sessionStorage.getItem(key) ?? "{}");
  } catch {
    return {}; // The browser keeps nothing, or somebody else has written there.
  }
}

/**
 * @param {string} key
 * @param {Record<string, Kept>} kept
 */
function save(key, kept) {
  try {
    sessionStorage.setItem(key, JSON.stringify(kept));
  } catch {
    // The browser keeps nothing: then values last as long as the page.
  }
}
