// The fields by which a person sets values: sliders, numbers, colours, directions, switches.

import { present } from "../web_host/present.js";
import { fromHex, strengthOf, toHex } from "./colors.js";
import { make } from "./elements.js";

/**
 * @import { Value } from "../web_host/host.js"
 * @import { Control } from "./documents.js"
 */

/**
 * A field that shows a value; its maker is called for every change that a person makes.
 * @template T
 * @typedef {object} Field
 * @property {HTMLElement} element
 * @property {(value: T) => void} show
 */

/**
 * A function that is called with a value that a person has set.
 * @template T
 * @typedef {(value: T) => void} Changed
 */

const DEGREES = 180 / Math.PI;
/** From this ratio of the ends of a range on, a slider goes by factors. */
const WIDE = 500;
/** The number of steps of a slider. */
const STEPS = 1000;
const LANES = ["x", "y", "z", "w"];

/**
 * The field of a control. `label` is the id of the element with its name.
 * @param {Control} control
 * @param {string} label
 * @param {Changed<Value>} changed
 * @returns {Field<Value>}
 */
export function fieldOf(control, label, changed) {
  return makers[control.kind](control, label, changed);
}

/**
 * Makes the field of a control.
 * @callback Maker
 * @param {Control} control
 * @param {string} label
 * @param {Changed<any>} changed
 * @returns {Field<any>}
 */

/** @type {Record<Control["kind"], Maker>} */
const makers = {
  number: (control, label, changed) => numberField(numbers(control), { label }, changed),
  angle: (control, label, changed) => angleField(control, label, changed),
  vector: (control, label, changed) => vectorField(control, label, changed),
  direction: (_control, label, changed) => directionField(label, changed),
  matrix: (control, label, changed) => matrixField(control, label, changed),
  color: (control, label, changed) => colorField(control, label, changed),
  checkbox: (_control, label, changed) => checkbox({ label }, changed),
  checkboxes: (control, label, changed) => checkboxes(control, label, changed),
  choice: (control, label, changed) => choiceField(control, label, changed),
  member: (control, label, changed) => memberField(control, label, changed),
  texture: () => { throw new Error("textures have fields of their own"); },
};

// --- numbers -------------------------------------------------------------------------------------

/**
 * The numbers that a field takes.
 * @typedef {object} Numbers
 * @property {[number, number] | null} range
 * @property {boolean} whole
 */

/**
 * The label of a field: the id of the element that labels it, or a word of its own.
 * @typedef {object} Naming
 * @property {string} label
 * @property {string} [word]
 */

/**
 * @param {Naming} naming
 * @returns {Record<string, string>}
 */
function naming({ label, word }) {
  return word ? { "aria-label": word, "aria-describedby": label } : { "aria-labelledby": label };
}

/**
 * @param {Control} control
 * @returns {Numbers}
 */
function numbers(control) {
  return { range: control.range ?? null, whole: control.whole ?? false };
}

/**
 * @param {Numbers} of
 * @param {Naming} named
 * @param {Changed<number>} changed
 * @returns {Field<number>}
 */
function numberField(of, named, changed) {
  const { range, whole } = of;
  const box = make("input", {
    type: "number", class: "number", step: whole ? 1 : "any",
    ...(range ? { min: range[0], max: range[1] } : {}), ...naming(named),
  });
  const inner = make("div", { class: range ? "slider" : "plain" }, box);
  if (named.word) inner.prepend(make("span", { class: "lane", "aria-hidden": true }, named.word));
  const slider = range ? sliderOf(range, whole, named) : null;
  if (slider) box.before(slider.element);
  /** @type {(value: number) => void} */
  const show = (value) => {
    box.value = value === null ? "" : shown(value, whole);
    slider?.show(value);
  };
  box.addEventListener("input", () => {
    const value = box.valueAsNumber;
    if (Number.isNaN(value)) return;
    const taken = range ? Math.min(Math.max(value, range[0]), range[1]) : value;
    slider?.show(taken);
    changed(whole ? Math.round(taken) : taken);
  });
  slider?.element.addEventListener("input", () => {
    const value = slider.value();
    box.value = shown(value, whole);
    changed(value);
  });
  // A number beyond the range becomes the nearer end of it when the field loses focus.
  box.addEventListener("change", () => {
    const value = box.valueAsNumber;
    if (Number.isNaN(value) || (range && (value < range[0] || value > range[1]))) {
      show(range ? Math.min(Math.max(value || 0, range[0]), range[1]) : 0);
      box.dispatchEvent(new Event("input"));
    }
  });
  return { element: inner, show };
}

/**
 * A slider; over a wide range of positive numbers it goes by factors.
 * @param {[number, number]} range
 * @param {boolean} whole
 * @param {Naming} named
 */
function sliderOf([low, high], whole, named) {
  const wide = low > 0 && high / low >= WIDE;
  const few = whole && high - low <= STEPS;
  const element = make("input", {
    type: "range", min: 0, max: few ? high - low : STEPS, step: few ? 1 : "any", ...naming(named),
  });
  const share = () => element.valueAsNumber / Number(element.max);
  const value = () => {
    const exact = wide ? low * (high / low) ** share() : low + share() * (high - low);
    return whole ? Math.round(exact) : rounded(exact, high - low);
  };
  /** @type {(given: number) => void} */
  const show = (given) => {
    const within = Math.min(Math.max(given ?? low, low), high);
    const at = wide ? Math.log(within / low) / Math.log(high / low) : (within - low) / (high - low);
    element.value = String((at || 0) * Number(element.max));
    element.style.setProperty("--share", `${100 * (at || 0)}%`);
    element.setAttribute("aria-valuetext", shown(given, whole));
  };
  element.addEventListener("input", () => {
    element.style.setProperty("--share", `${100 * share()}%`);
    element.setAttribute("aria-valuetext", shown(value(), whole));
  });
  return { element, value, show };
}

/**
 * A number that a slider gives, without more digits than anybody can tell apart.
 * @param {number} value
 * @param {number} width
 * @returns {number}
 */
function rounded(value, width) {
  const digits = Math.max(0, 4 - Math.floor(Math.log10(width || 1)));
  return Number(value.toFixed(Math.min(digits, 12)));
}

/**
 * @param {number} value
 * @param {boolean} whole
 * @returns {string}
 */
function shown(value, whole) {
  return value === null ? "" : whole ? String(value) : String(Number(value.toPrecision(5)));
}

/**
 * @param {Control} control
 * @param {string} label
 * @param {Changed<number>} changed
 * @returns {Field<number>}
 */
function angleField(control, label, changed) {
  const [low, high] = control.range ?? [-Math.PI, Math.PI];
  /** @type {Numbers} */
  const of = { range: [low * DEGREES, high * DEGREES], whole: false };
  const field = numberField(of, { label }, (degrees) => changed(degrees / DEGREES));
  field.element.classList.add("degrees");
  return { element: field.element, show: (value) => field.show(value * DEGREES) };
}

/**
 * Several numbers below each other.
 * @param {string[]} words
 * @param {Numbers} of
 * @param {string} label
 * @param {Changed<number[]>} changed
 * @returns {Field<number[]>}
 */
function severalOf(words, of, label, changed) {
  /** @type {number[]} */
  let values = words.map(() => 0);
  const fields = words.map((word, lane) =>
    numberField(of, { label, word }, (value) => {
      values = values.map((old, at) => (at === lane ? value : old));
      changed(values);
    }),
  );
  const element = make("div", { class: of.range ? "several" : "beside" });
  element.append(...fields.map((field) => field.element));
  /** @type {(given: number[]) => void} */
  const show = (given) => {
    values = given ? [...given] : words.map(() => 0);
    fields.forEach((field, lane) => field.show(values[lane]));
  };
  return { element, show };
}

/**
 * @param {Control} control
 * @param {string} label
 * @param {Changed<number[]>} changed
 * @returns {Field<number[]>}
 */
function vectorField(control, label, changed) {
  return severalOf(LANES.slice(0, control.lanes), numbers(control), label, changed);
}

/**
 * A direction as two angles: around the vertical, and above the horizon.
 * @param {string} label
 * @param {Changed<number[]>} changed
 * @returns {Field<number[]>}
 */
function directionField(label, changed) {
  /** @type {Numbers} */
  const around = { range: [-180, 180], whole: false };
  /** @type {Numbers} */
  const above = { range: [-90, 90], whole: false };
  let [yaw, pitch] = [0, 0];
  const tell = () => {
    const [a, b] = [yaw / DEGREES, pitch / DEGREES];
    changed([Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)]);
  };
  const fields = /** @type {const} */ ([
    numberField(around, { label, word: "around" }, (value) => { yaw = value; tell(); }),
    numberField(above, { label, word: "up" }, (value) => { pitch = value; tell(); }),
  ]);
  const element = make("div", { class: "several degrees" }, ...fields.map((each) => each.element));
  /** @type {(given: number[]) => void} */
  const show = (given) => {
    const [x, y, z] = given ?? [0, 0, 1];
    yaw = Math.atan2(x, z) * DEGREES;
    pitch = Math.asin(Math.min(Math.max(y, -1), 1)) * DEGREES;
    fields[0].show(yaw);
    fields[1].show(pitch);
  };
  return { element, show };
}

/**
 * A matrix, with a field for each row.
 * @param {Control} control
 * @param {string} label
 * @param {Changed<number[][]>} changed
 * @returns {Field<number[][]>}
 */
function matrixField(control, label, changed) {
  const [rows, columns] = [present(control.lanes), present(control.columns)];
  /** @type {number[][]} */
  let values = [];
  const of = { range: control.range ?? null, whole: false };
  const fields = Array.from({ length: rows }, (_, row) =>
    Array.from({ length: columns }, (_, column) =>
      numberField({ ...of, range: null }, { label, word: `${row + 1},${column + 1}` }, (value) => {
        values = values.map((lanes, c) =>
          c === column ? lanes.map((old, r) => (r === row ? value : old)) : lanes,
        );
        changed(values);
      }),
    ),
  );
  const element = make("div", { class: "matrix" });
  element.style.setProperty("--columns", String(columns));
  element.append(...fields.flat().map((field) => field.element));
  /** @type {(given: number[][]) => void} */
  const show = (given) => {
    values = given ?? Array.from({ length: columns }, () => Array(rows).fill(0));
    fields.forEach((line, row) => line.forEach((field, c) => field.show(values[c][row])));
  };
  return { element, show };
}

// --- colours, switches, choices ------------------------------------------------------------------

/**
 * A colour; with a strength where it may be brighter than any picker's, and with an alpha where it
 * has one.
 * @param {Control} control
 * @param {string} label
 * @param {Changed<number[]>} changed
 * @returns {Field<number[]>}
 */
function colorField(control, label, changed) {
  const picker = make("input", { type: "color", "aria-labelledby": label });
  const code = make("output", { class: "code" });
  const element = make("div", { class: "color" }, make("div", { class: "pick" }, picker, code));
  const given = /** @type {number[]} */ (control.value ?? [0, 0, 0]);
  let [strength, alpha] = [1, 1];
  const tell = () => {
    code.value = picker.value;
    const color = fromHex(picker.value, strength);
    changed(control.lanes === 4 ? [...color, alpha] : color);
  };
  picker.addEventListener("input", tell);
  const bright = control.is_light || strengthOf(given) > 1;
  const strong = numberField({ range: bright ? [0, 16] : null, whole: false },
    { label, word: "strength" }, (value) => { strength = value; tell(); });
  if (bright) element.append(strong.element);
  const clear = numberField({ range: [0, 1], whole: false },
    { label, word: "alpha" }, (value) => { alpha = value; tell(); });
  if (control.lanes === 4) element.append(clear.element);
  /** @type {(value: number[]) => void} */
  const show = (value) => {
    const color = value ?? [0, 0, 0];
    strength = strengthOf(color);
    alpha = color[3] ?? 1;
    picker.value = toHex(color, strength);
    code.value = picker.value;
    strong.show(strength);
    clear.show(alpha);
  };
  return { element, show };
}

/**
 * @param {Naming} named
 * @param {Changed<boolean>} changed
 * @returns {Field<boolean>}
 */
function checkbox(named, changed) {
  const element = make("input", { type: "checkbox", class: "switch", ...naming(named) });
  element.addEventListener("change", () => changed(element.checked));
  return { element, show: (value) => { element.checked = Boolean(value); } };
}

/**
 * @param {Control} control
 * @param {string} label
 * @param {Changed<boolean[]>} changed
 * @returns {Field<boolean[]>}
 */
function checkboxes(control, label, changed) {
  /** @type {boolean[]} */
  let values = [];
  const fields = LANES.slice(0, control.lanes).map((word, lane) =>
    checkbox({ label, word }, (value) => {
      values = values.map((old, at) => (at === lane ? value : old));
      changed(values);
    }),
  );
  const element = make("div", { class: "beside" }, ...fields.map((field) => field.element));
  /** @type {(given: boolean[]) => void} */
  const show = (given) => {
    values = given ?? fields.map(() => false);
    fields.forEach((field, lane) => field.show(values[lane]));
  };
  return { element, show };
}

/**
 * @param {Control} control
 * @param {string} label
 */
function listOf(control, label) {
  const words = present(control.choices).map((word) => make("option", { value: word }, word));
  return make("select", { "aria-labelledby": label }, ...words);
}

/**
 * A list of the members of an enumeration; their numbers are the values.
 * @param {Control} control
 * @param {string} label
 * @param {Changed<number>} changed
 * @returns {Field<number>}
 */
function memberField(control, label, changed) {
  const element = listOf(control, label);
  element.addEventListener("change", () => changed(element.selectedIndex));
  return { element, show: (value) => { element.selectedIndex = value; } };
}

/**
 * @param {Control} control
 * @param {string} label
 * @param {Changed<string>} changed
 * @returns {Field<string>}
 */
function choiceField(control, label, changed) {
  const element = listOf(control, label);
  element.addEventListener("change", () => changed(element.value));
  return { element, show: (value) => { element.value = value; } };
}
