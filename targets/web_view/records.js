// The elements of a buffer as numbers, read by the layout in the rows of the reflection.

import { present } from "../web_host/present.js";

/** @import { CaptureRow, MemberRow, Package } from "../web_host/generated/documents.js" */

/**
 * A number, vector, matrix or list of numbers that each element has.
 * @typedef {object} Column
 * @property {string} name
 * @property {string} type
 * @property {"float" | "int" | "uint" | "bool"} kind
 * @property {number[]} places The offset of each of its lanes in an element, in bytes.
 */

/**
 * The layout of an output's elements in its buffer.
 * @typedef {object} Layout
 * @property {string} type
 * @property {number} stride
 * @property {Column[]} columns
 * @property {1 | 2 | 3} corners The number of successive elements that make a primitive; 1
 *   unless they are captured vertices.
 * @property {number | null} there
 */

const CORNERS = /** @type {const} */ ({
  "point-list": 1, "line-list": 2, "triangle-list": 3,
});

/**
 * The layout of an output that is a buffer; null for a picture.
 * @param {Package} from
 * @param {string} output
 * @returns {Layout | null}
 */
export function layoutOf(from, output) {
  const row = from.plan.outputs.find(({ name }) => name === output);
  if (!row || row.texture !== null) return null;
  for (const step of from.plan.steps) {
    const written = step.kind === "run" && step.buffers.find(({ result }) => result === row.result);
    if (!written) continue;
    const { results, capture } = from.shaders[step.use.shader].reflection;
    const result = present(results.find(({ name }) => name === written.name));
    const captured = capture?.buffer === result.name ? capture : null;
    return {
      type: captured ? "vertex" : ofElement(result.type),
      stride: result.stride,
      columns: captured ? captured.members.map(ofCapture) : columnsOf(result, "", 0),
      corners: CORNERS[captured?.topology ?? "point-list"],
      there: captured?.there ?? null,
    };
  }
  return null;
}

/**
 * @param {CaptureRow["members"][number]} capture
 * @returns {Column}
 */
function ofCapture({ name, representation, offset }) {
  const kind = /** @type {const} */ ({ i: "int", u: "uint" })[representation[0]] ?? "float";
  const lanes = Number(/\d$/.exec(representation)?.[0] ?? 1);
  const places = Array.from({ length: lanes }, (_, lane) => offset + 4 * lane);
  return { name, type: representation, kind, places };
}

/** The type of the elements of a buffer. @type {(type: string) => string} */
const ofElement = (type) => type.replace(/\[\]$/, "");

/**
 * The columns of a value; those of a structure are called `member` and `member.part`.
 * @param {Pick<MemberRow, "type" | "layout" | "members">} row
 * @param {string} name
 * @param {number} offset
 * @returns {Column[]}
 */
function columnsOf(row, name, offset) {
  if (row.members.length) {
    const within = name ? `${name}.` : "";
    return row.members.flatMap((each) =>
      columnsOf(each, within + each.name, offset + each.offset),
    );
  }
  const { layout } = row;
  const type = ofElement(row.type);
  const kind = /^bvec|^bool/.test(type) ? "bool" : (layout.kind ?? "uint");
  /** @type {(count: number, stride: number) => number[]} */
  const some = (count, stride) => Array.from({ length: count }, (_, at) => at * stride);
  const places = some(layout.count ?? 1, layout.stride ?? 0).flatMap((element) =>
    some(layout.columns ?? 1, layout.column_stride ?? 0).flatMap((column) =>
      some(layout.lanes ?? 1, 4).map((lane) => offset + element + column + lane),
    ),
  );
  return [{ name, type, kind, places }];
}

/** The elements of a buffer. */
export class Elements {
  /** @readonly @type {number} */
  count;
  /** @type {DataView} */
  #view;
  /** The numbers of the elements that are there, if some are not. @type {number[] | null} */
  #present = null;

  /** @readonly */
  layout;

  /**
   * @param {Layout} layout
   * @param {Uint8Array} bytes
   */
  constructor(layout, bytes) {
    this.layout = layout;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const { stride, there } = layout;
    const whole = Math.floor(bytes.byteLength / stride);
    if (there !== null) {
      this.#present = Array.from({ length: whole }, (_, at) => at).filter(
        (at) => this.#view.getUint32(at * stride + there, true) !== 0,
      );
    }
    this.count = this.#present?.length ?? whole;
  }

  /**
   * One lane of an element in a column.
   * @param {Column} column
   * @param {number} lane
   * @param {number} element
   * @returns {number}
   */
  get(column, lane, element) {
    const number = this.#present ? this.#present[element] : element;
    const at = number * this.layout.stride + column.places[lane];
    if (column.kind === "float") return this.#view.getFloat32(at, true);
    return column.kind === "int" ? this.#view.getInt32(at, true) : this.#view.getUint32(at, true);
  }

  /**
   * The text of an element in a column, for people.
   * @param {Column} column
   * @param {number} element
   * @returns {string}
   */
  text(column, element) {
    return column.places.map((_, lane) => {
      const value = this.get(column, lane, element);
      if (column.kind === "bool") return value ? "true" : "false";
      return column.kind === "float" && Number.isFinite(value)
        ? String(Number(value.toPrecision(5))) : String(value);
    }).join(", ");
  }
}
