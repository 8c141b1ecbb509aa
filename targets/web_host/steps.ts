// Computes values from the steps of a plan or a reflection: see "Derived values" in
// docs/reflection.md.

import { LANEWISE, WHOLE, type Kind, type Lanes } from "./generated/builtins.js";
import type { DerivedRow } from "./generated/documents.js";

/** An operation. */
export type Step = DerivedRow["steps"][number];
type Fold = Extract<Step, { op: "fold" }>;

/** Lanes of a number or a vector, columns, elements, or members by name. */
export type Datum = number[] | Datum[] | { [member: string]: Datum };

/** The texels of a texture's first level in each direction. */
export type SizeOf = (texture: string) => number[];
type Parameter = (name: string) => Datum;

/** The value of the last step. `element` is the number of the element of an array, if it is one's
 * value. */
export function compute(
  steps: Step[], parameter: Parameter, sizeOf: SizeOf, element?: number,
): Datum {
  const bound = element === undefined ? [] : [[element]];
  return new Computation(steps, parameter, sizeOf).body(steps.length - 1, bound);
}

class Computation {
  private readonly depths: number[];
  private readonly constant = new Map<number, Datum>();

  constructor(
    private readonly steps: Step[],
    private readonly parameter: Parameter,
    private readonly sizeOf: SizeOf,
  ) {
    this.depths = depthsOf(steps);
  }

  /** The value of a step; `bound` are the variables around it, the innermost first. */
  body(last: number, bound: Datum[]): Datum {
    const varying = new Map<number, Datum>();
    const valuesOf = (number: number) => (this.depths[number] ? varying : this.constant);
    for (const number of this.needed(last)) {
      const row = this.steps[number];
      const operands = outside(row).map((each) => valuesOf(each).get(each)!);
      valuesOf(number).set(number, this.step(row, operands, bound));
    }
    return valuesOf(last).get(last)!;
  }

  /** The steps that one needs and that are not known, in their order. */
  private needed(last: number): number[] {
    const found = new Set<number>();
    const pending = [last];
    for (let number = pending.pop(); number !== undefined; number = pending.pop()) {
      if (found.has(number) || this.constant.has(number)) continue;
      found.add(number);
      pending.push(...outside(this.steps[number]));
    }
    return [...found].sort((a, b) => a - b);
  }

  private step(row: Step, operands: Datum[], bound: Datum[]): Datum {
    const values = operands as number[][];
    switch (row.op) {
      case "parameter":
        return this.parameter(row.parameter);
      case "resource":
        return this.sizeOf(row.texture);
      case "constant":
        return constantOf(row.value);
      case "native":
      case "call":
        if (row.function === "texture_size") {
          return values[0].map((side) => Math.max(side >> Math.max(values[1][0], 0), 1));
        }
        return evaluate(row.function, values, kindOf(this.steps[row.args[0]].type));
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
        return this.fold(row, values, bound);
    }
  }

  private fold(row: Fold, [[count], start]: number[][], bound: Datum[]): Datum {
    let result: Lanes = start;
    for (let turn = 0; turn < Math.min(count, row.bound); turn++) {
      const value = this.body(row.args[2], [[turn], ...bound]) as number[];
      result = evaluate(row.operator, [result, value], kindOf(row.type));
    }
    return result;
  }
}

/** The value of a builtin; `kind` is the type of the operands' lanes. */
export function evaluate(name: string, operands: Lanes[], kind: Kind): Lanes {
  const shapes = operands.map((each) =>
    Array.isArray(each[0]) ? `${each.length}x${each[0].length}` : each.length,
  );
  const whole = WHOLE[[name, kind, ...shapes].join(" ")];
  if (whole) return whole(...operands);
  const lanewise = LANEWISE[`${name} ${kind}`];
  if (!lanewise) throw new Error(`this host does not know the function ${name} of ${kind}`);
  const lanes = operands as number[][];
  return Array.from({ length: Math.max(...lanes.map((each) => each.length)) }, (_, at) =>
    lanewise(...lanes.map((each) => each[each.length === 1 ? 0 : at])),
  );
}

/** An element or a member of a value; a number is one lane. */
function partOf(value: Datum, key: string | number): Datum {
  const part = (value as any)[key];
  return typeof part === "number" ? [part] : part;
}

/** The arguments that are not a body under the step's binder. */
function outside(row: Step): number[] {
  if (row.op === "fold") return row.args.slice(0, 2);
  return row.op === "apply" ? row.args.slice(1) : row.args;
}

/** For each step, how many of the binders around it bind a variable that it uses. */
function depthsOf(steps: Step[]): number[] {
  const depths: number[] = [];
  for (const row of steps) {
    let depth = Math.max(0, ...outside(row).map((each) => depths[each]));
    if (row.op === "bound") depth = row.binder + 1;
    if (row.op === "fold") depth = Math.max(depth, depths[row.args[2]] - 1);
    if (row.op === "apply") depth = Math.max(depth, depths[row.args[0]] - row.args.length + 1);
    depths.push(depth);
  }
  return depths;
}

function constantOf(value: unknown): Datum {
  const lanes = Array.isArray(value) ? value : [value];
  return lanes.map((lane) => (Array.isArray(lane) ? lane.map(Number) : Number(lane))) as Datum;
}

/** The type of the lanes of a number, vector or matrix. */
export function kindOf(type: string): Kind {
  if (type === "int" || type === "uint" || type === "bool") return type;
  const kinds: Record<string, Kind> = { ivec: "int", uvec: "uint", bvec: "bool" };
  return kinds[type.slice(0, 4)] ?? "float";
}
