// Computes values from the steps of a plan or a reflection: see "Derived values" in
// docs/reflection.md.

import { LANEWISE, WHOLE } from "./generated/builtins.js";
import { present } from "./present.js";

/**
 * @import { Datum } from "./datum.js"
 * @import { Kind, Lanes } from "./generated/builtins.js"
 * @import { DerivedRow } from "./generated/documents.js"
 */

/** An operation. @typedef {DerivedRow["steps"][number]} Step */
/** @typedef {Extract<Step, { op: "fold" }>} Fold */

/**
 * The texels of a texture's first level in each direction.
 * @typedef {(texture: string) => number[]} SizeOf
 */
/** @typedef {(name: string) => Datum} Parameter */

/**
 * The value of the last step. If it is the value of an element of an array, `element` is its
 * number.
 * @param {Step[]} steps
 * @param {Parameter} parameter
 * @param {SizeOf} sizeOf
 * @param {number} [element]
 * @returns {Datum}
 */
export function compute(steps, parameter, sizeOf, element) {
  const bound = element === undefined ? [] : [[element]];
  return new Computation(steps, parameter, sizeOf).body(steps.length - 1, bound);
}

class Computation {
  /** @type {number[]} */
  #depths;
  /** @type {Map<number, Datum>} */
  #constant = new Map();

  #steps;
  #parameter;
  #sizeOf;

  /**
   * @param {Step[]} steps
   * @param {Parameter} parameter
   * @param {SizeOf} sizeOf
   */
  constructor(steps, parameter, sizeOf) {
    this.#steps = steps;
    this.#parameter = parameter;
    this.#sizeOf = sizeOf;
    this.#depths = depthsOf(steps);
  }

  /**
   * The value of a step; `bound` has the values of the variables around it, the innermost first.
   * @param {number} last
   * @param {Datum[]} bound
   * @returns {Datum}
   */
  body(last, bound) {
    /** @type {Map<number, Datum>} */
    const varying = new Map();
    /** @type {(number: number) => Map<number, Datum>} */
    const valuesOf = (number) => (this.#depths[number] ? varying : this.#constant);
    for (const number of this.#needed(last)) {
      const row = this.#steps[number];
      const operands = outside(row).map((each) => present(valuesOf(each).get(each)));
      valuesOf(number).set(number, this.#step(row, operands, bound));
    }
    return present(valuesOf(last).get(last));
  }

  /**
   * The steps that a step needs and whose values are not known yet, in their order.
   * @param {number} last
   * @returns {number[]}
   */
  #needed(last) {
    /** @type {Set<number>} */
    const found = new Set();
    const pending = [last];
    for (let number = pending.pop(); number !== undefined; number = pending.pop()) {
      if (found.has(number) || this.#constant.has(number)) continue;
      found.add(number);
      pending.push(...outside(this.#steps[number]));
    }
    return [...found].sort((a, b) => a - b);
  }

  /**
   * @param {Step} row
   * @param {Datum[]} operands
   * @param {Datum[]} bound
   * @returns {Datum}
   */
  #step(row, operands, bound) {
    const values = /** @type {number[][]} */ (operands);
    switch (row.op) {
      case "parameter":
        return this.#parameter(row.parameter);
      case "texture":
        return this.#sizeOf(row.texture);
      case "constant":
        return constantOf(row.value);
      case "native":
      case "call":
        if (row.function === "texture_size") {
          return values[0].map((side) => Math.max(side >> Math.max(values[1][0], 0), 1));
        }
        return evaluate(row.function, values, kindOf(this.#steps[row.args[0]].type));
      case "bound":
        return bound[row.binder];
      case "index":
        return partOf(operands[0], values[1][0]);
      case "member":
        return partOf(operands[0], row.member);
      case "swizzle":
        return row.lanes.map((lane) => values[0][lane]);
      case "vector":
        return values.flat();
      case "splat":
        return Array(Number(row.type.slice(-1))).fill(values[0][0]);
      case "matrix":
      case "array":
        return operands;
      case "select":
        return values[0][0] ? operands[1] : operands[2];
      case "apply":
        return this.body(row.args[0], [...operands, ...bound]);
      case "fold":
        return this.#fold(row, values, bound);
    }
  }

  /**
   * @param {Fold} row
   * @param {number[][]} operands
   * @param {Datum[]} bound
   * @returns {Datum}
   */
  #fold(row, [[count], start], bound) {
    /** @type {Lanes} */
    let result = start;
    for (let turn = 0; turn < Math.min(count, row.bound); turn++) {
      const value = /** @type {number[]} */ (this.body(row.args[2], [[turn], ...bound]));
      result = evaluate(row.operator, [result, value], kindOf(row.type));
    }
    return result;
  }
}

/**
 * The value of a builtin; `kind` is the type of the operands' lanes.
 * @param {string} name
 * @param {Lanes[]} operands
 * @param {Kind} kind
 * @returns {Lanes}
 */
export function evaluate(name, operands, kind) {
  const shapes = operands.map((each) =>
    Array.isArray(each[0]) ? `${each.length}x${each[0].length}` : each.length,
  );
  const whole = WHOLE[[name, kind, ...shapes].join(" ")];
  if (whole) return whole(...operands);
  const lanewise = LANEWISE[`${name} ${kind}`];
  if (!lanewise) throw new Error(`this host does not know the function ${name} of ${kind}`);
  const lanes = /** @type {number[][]} */ (operands);
  return Array.from({ length: Math.max(...lanes.map((each) => each.length)) }, (_, at) =>
    lanewise(...lanes.map((each) => each[each.length === 1 ? 0 : at])),
  );
}

/**
 * An element or a member of a value; a number is one lane.
 * @param {Datum} value
 * @param {string | number} key
 * @returns {Datum}
 */
function partOf(value, key) {
  const part = /** @type {any} */ (value)[key];
  return typeof part === "number" ? [part] : part;
}

/**
 * The arguments that the step's binder does not bind: all but its bodies.
 * @param {Step} row
 * @returns {number[]}
 */
function outside(row) {
  if (row.op === "fold") return row.args.slice(0, 2);
  return row.op === "apply" ? row.args.slice(1) : row.args;
}

/**
 * For each step the number of the binders around it that bind a variable that it uses.
 * @param {Step[]} steps
 * @returns {number[]}
 */
function depthsOf(steps) {
  /** @type {number[]} */
  const depths = [];
  for (const row of steps) {
    let depth = Math.max(0, ...outside(row).map((each) => depths[each]));
    if (row.op === "bound") depth = row.binder + 1;
    if (row.op === "fold") depth = Math.max(depth, depths[row.args[2]] - 1);
    if (row.op === "apply") depth = Math.max(depth, depths[row.args[0]] - row.args.length + 1);
    depths.push(depth);
  }
  return depths;
}

/**
 * @param {unknown} value
 * @returns {Datum}
 */
function constantOf(value) {
  const lanes = Array.isArray(value) ? value : [value];
  return /** @type {Datum} */ (
    lanes.map((lane) => (Array.isArray(lane) ? lane.map(Number) : Number(lane)))
  );
}

/**
 * The type of the lanes of a number, vector or matrix.
 * @param {string} type
 * @returns {Kind}
 */
export function kindOf(type) {
  if (type === "int" || type === "uint" || type === "bool") return type;
  /** @type {Record<string, Kind>} */
  const kinds = { ivec: "int", uvec: "uint", bvec: "bool" };
  return kinds[type.slice(0, 4)] ?? "float";
}
