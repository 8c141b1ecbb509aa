// Named values of a frame or a shader, and the bytes of uniform blocks that they become.

import { present } from "./present.js";
import { compute, kindOf } from "./steps.js";

/**
 * @import { Datum } from "./datum.js"
 * @import {
 *   DerivedRow, MemberRow, ParameterRow, Reflection, Value,
 * } from "./generated/documents.js"
 * @import { SizeOf, Step } from "./steps.js"
 */

/**
 * The parts of a plan or a reflection that declare values.
 * @typedef {Pick<
 *   Reflection, "parameters" | "lights" | "buffers" | "blocks" | "derived"
 * >} Declarations
 */

/**
 * A value, with the place of its lanes.
 * @typedef {Pick<MemberRow, "name" | "representation" | "layout"> & Partial<
 *   Pick<ParameterRow, "type" | "members" | "default" | "range" | "count">
 * >} Placed
 */

/** A vector, or the columns of a matrix. @typedef {number[] | number[][]} Lanes */

const UNIT_TYPES = /^(direction|normal)\b/;
const UNIT_TOLERANCE = 1e-3;

/** The values of one shader, or of a frame. They begin with the declared defaults. */
export class Values {
  /** @type {Map<string, ParameterRow>} */
  #rows = new Map();
  /** The lanes of the parts that have no parts themselves, by name. @type {Map<string, Lanes>} */
  #lanes = new Map();
  /** The parameters that have a value. @type {Set<string>} */
  #known = new Set();

  /** The name of their owner, for messages. @readonly */
  name;
  /** @readonly */
  declared;

  /**
   * @param {string} name
   * @param {Declarations} declared
   * @param {Values | null} [original] what these values are a copy of
   */
  constructor(name, declared, original = null) {
    this.name = name;
    this.declared = declared;
    if (original) {
      this.#rows = original.#rows;
      this.#lanes = new Map(original.#lanes);
      this.#known = new Set(original.#known);
      return;
    }
    for (const row of declared.parameters) {
      this.#rows.set(row.name, row);
      for (const [name, lanes] of defaults(row, row.name)) this.#lanes.set(name, lanes);
      if (row.count || row.default !== null) this.#known.add(row.name);
    }
  }

  /**
   * A copy of the values, which can be changed without changing these.
   * @returns {Values}
   */
  copied() {
    return new Values(this.name, this.declared, this);
  }

  /**
   * True if a parameter, a part of one, or a light has this name.
   * @param {string} name
   * @returns {boolean}
   */
  has(name) {
    return Boolean(this.#find(name) ?? this.#lightOf(name));
  }

  /**
   * Set a parameter, a part of one, or a light. Parts that are left out, or null, stay as they
   * are; at first, each part has its default, or zero.
   * @param {string} name
   * @param {Value} value
   */
  set(name, value) {
    const found = this.#find(name);
    if (found) {
      const { parameter, part } = found;
      // The whole value is checked before the first part is set, so an error sets nothing.
      for (const [each, lanes] of [...accepted(part, value)]) this.#lanes.set(each, lanes);
      this.#known.add(parameter.name);
      const isList = part.row === parameter && Array.isArray(value);
      if (isList && parameter.count) this.set(parameter.count, value.length);
      return;
    }
    if (!this.#lightOf(name)) throw new Error(`${this.name} has no parameter \`${name}\``);
    for (const [member, part] of Object.entries(value ?? {})) this.set(`${name}.${member}`, part);
  }

  /**
   * Set the number of elements of a storage buffer.
   * @param {Declarations["buffers"][number]} buffer
   * @param {number} bytes
   */
  count(buffer, bytes) {
    this.set(buffer.count, Math.floor(bytes / buffer.stride));
  }

  /**
   * The stored value. Throws an error if it must be set first.
   * @param {string} name
   * @returns {Datum}
   */
  get(name) {
    const found = this.#find(name);
    if (!found || !this.#known.has(found.parameter.name)) {
      throw new Error(`${this.name} needs a value for \`${name}\``);
    }
    return this.#whole(found.part);
  }

  /**
   * @param {Part} part
   * @returns {Datum}
   */
  #whole({ row, name }) {
    const parts = partsOf(row, name);
    if (!parts.length) return present(this.#lanes.get(name));
    if (row.layout.count !== undefined) return parts.map((each) => this.#whole(each));
    return Object.fromEntries(parts.map((each) => [each.key, this.#whole(each)]));
  }

  /**
   * The value that steps compute. `size` returns the sizes of the textures that they read.
   * @param {Step[]} steps
   * @param {SizeOf} [size]
   * @param {number} [element]
   * @returns {Datum}
   */
  evaluated(steps, size = noTexture, element) {
    return compute(steps, (name) => this.get(name), size, element);
  }

  /**
   * The bytes of every block, those of derived values included.
   * @returns {Map<string, Uint8Array<ArrayBuffer>>}
   */
  blocks() {
    const { blocks, parameters, derived } = this.declared;
    const found = new Map(blocks.map(({ name, size }) => [name, new ArrayBuffer(size)]));
    /** @type {(row: ParameterRow | DerivedRow, value: () => Datum) => void} */
    const put = (row, value) => {
      if (row.block === null) return;
      write(new DataView(present(found.get(row.block))), present(row.offset), row, value());
    };
    for (const row of parameters) put(row, () => this.get(row.name));
    for (const row of derived) put(row, () => this.#derivedOf(row));
    return new Map([...found].map(([name, buffer]) => [name, new Uint8Array(buffer)]));
  }

  /**
   * @param {DerivedRow} derived
   * @returns {Datum}
   */
  #derivedOf({ steps, layout: { count } }) {
    if (count === undefined) return this.evaluated(steps);
    return Array.from({ length: count }, (_, at) => this.evaluated(steps, noTexture, at));
  }

  /**
   * The parameter, or the part of one, that has this name.
   * @param {string} name
   * @returns {{ parameter: ParameterRow, part: Part } | undefined}
   */
  #find(name) {
    for (let end = name.length; end > 0; end = name.slice(0, end).search(/[.[][^.[]*$/)) {
      const parameter = this.#rows.get(name.slice(0, end));
      if (!parameter) continue;
      /** @type {string[]} */
      const path = name.slice(end).match(/\w+/g) ?? [];
      return { parameter, part: path.reduce(partOf, { row: parameter, name: parameter.name }) };
    }
    return undefined;
  }

  /** @param {string} name */
  #lightOf(name) {
    return this.declared.lights.find((each) => each.name === name && each.capacity === null);
  }
}

/** @type {(name: string) => never} */
const noTexture = (name) => {
  throw new Error(`the size of the texture \`${name}\` is not known here`);
};

// --- parts ---------------------------------------------------------------------------------------

/**
 * A value, or an element or member of one, with its whole name.
 * @typedef {object} Part
 * @property {Placed} row
 * @property {string} name
 */

/**
 * The elements or members of a value, if it has any, each with its offset in it.
 * @param {Placed} row
 * @param {string} name
 * @returns {(Part & { key: string | number, offset: number })[]}
 */
function partsOf(row, name) {
  const { count, stride, ...layout } = row.layout;
  if (count === undefined) {
    return (row.members ?? []).map((each) => {
      return { key: each.name, row: each, name: `${name}.${each.name}`, offset: each.offset };
    });
  }
  const one = (type = "") => type.replace(/\[[^[]*\]$/, "");
  /** @type {Placed} */
  const element = {
    name: row.name, type: one(row.type), representation: one(row.representation), layout,
    members: row.members, range: row.range,
  };
  return Array.from({ length: count }, (_, key) => {
    return { key, row: element, name: `${name}[${key}]`, offset: key * present(stride) };
  });
}

/**
 * @param {Part} part
 * @param {string} step
 * @returns {Part}
 */
function partOf({ row, name }, step) {
  const found = partsOf(row, name).find(({ key }) => `${key}` === step);
  if (!found) throw new Error(`\`${row.name}\` has no part \`${step}\``);
  return found;
}

/**
 * The lanes of all parts of a value: zero, or what is declared for a part or for all of them.
 * @param {Placed} row
 * @param {string} name
 * @returns {Generator<[string, Lanes]>}
 */
function* defaults(row, name) {
  const parts = partsOf(row, name);
  for (const each of parts) yield* defaults(each.row, each.name);
  const { columns, lanes } = row.layout;
  const zero = Array(lanes).fill(0);
  if (!parts.length) yield [name, columns ? Array(columns).fill(zero) : zero];
  if ((row.default ?? null) !== null) yield* accepted({ row, name }, present(row.default));
}

/**
 * The lanes of a value that a host sets, for each part that it gives.
 * @param {Part} part
 * @param {Value} value
 * @returns {Generator<[string, Lanes]>}
 */
function* accepted({ row, name }, value) {
  if (value === null) return;
  const { count, columns } = row.layout;
  const parts = partsOf(row, name);
  if (count !== undefined) check(value, name, count, Boolean(row.count));
  if (columns && !parts.length) {
    yield [name, check(value, name, columns).map((column) => vector(row, column, name))];
  } else if (!parts.length) {
    yield [name, vector(row, value, name)];
  }
  for (const [at, each] of parts.entries()) {
    const members = /** @type {Record<string, Value>} */ (value);
    yield* accepted(each, (Array.isArray(value) ? value[at] : members[each.key]) ?? null);
  }
}

/**
 * @param {Value} value
 * @param {string} name
 * @param {number} count
 * @returns {Value[]}
 */
function check(value, name, count, orFewer = false) {
  const length = Array.isArray(value) ? value.length : Infinity;
  if (length === count || (orFewer && length < count)) return /** @type {Value[]} */ (value);
  throw new Error(`\`${name}\` takes ${count} elements`);
}

/**
 * @param {Placed} placed
 * @param {Value} value
 * @param {string} name
 */
function vector({ layout, type = "", representation, range }, value, name) {
  const given = [value].flat().map((lane) => (typeof lane === "boolean" ? Number(lane) : lane));
  const { lanes: count, columns } = layout;
  /** @type {(why: string) => Error} */
  const refuse = (why) => new Error(`\`${name}\` ${why}`);
  if (given.length !== count || given.some((lane) => typeof lane !== "number")) {
    throw refuse(`(${type}) takes ${count === 1 ? "one number" : `${count} numbers`}`);
  }
  const isFloat = kindOf(representation) === "float";
  const lanes = /** @type {number[]} */ (given).map((lane) => (isFloat ? Math.fround(lane) : lane));
  const [low, high] = range ?? [-Infinity, Infinity];
  for (const lane of lanes) {
    if (!Number.isFinite(lane)) throw refuse("takes finite numbers");
    if (!isFloat && !Number.isInteger(lane)) throw refuse("takes whole numbers");
    if (lane < Math.fround(low) || lane > Math.fround(high)) {
      throw refuse(`is declared in ${low}..${high}: ${lane} is not`);
    }
  }
  if (count > 1 && !columns && UNIT_TYPES.test(type)) {
    const length = Math.hypot(...lanes);
    if (Math.abs(length - 1) > UNIT_TOLERANCE) throw refuse(`has to be of length 1, not ${length}`);
  }
  return lanes;
}

/**
 * Write a value at the place that its row gives, `offset` bytes from the start.
 * @param {DataView} view
 * @param {number} offset
 * @param {Placed} row
 * @param {Datum} value
 */
function write(view, offset, row, value) {
  const parts = partsOf(row, "");
  const members = /** @type {Record<string, Datum>} */ (value);
  for (const each of parts) {
    write(view, offset + each.offset, each.row, members[each.key]);
  }
  if (parts.length) return;
  const { columns, column_stride, kind } = row.layout;
  const vectors = /** @type {number[][]} */ (columns ? value : [value]);
  vectors.forEach((lanes, column) => lanes.forEach((lane, at) => {
    const place = offset + column * (column_stride ?? 0) + 4 * at;
    if (kind === "float") view.setFloat32(place, lane, true);
    else view.setInt32(place, lane | 0, true);
  }));
}
