// Computes values from the steps of a plan or a reflection: see "Derived values" in
// docs/reflection.md.
import { LANEWISE, WHOLE } from "./generated/builtins.js";
/** The value of the last step. `element` is the number of the element of an array, if it is one's
 * value. */
export function compute(steps, parameter, sizeOf, element) {
    const bound = element === undefined ? [] : [[element]];
    return new Computation(steps, parameter, sizeOf).body(steps.length - 1, bound);
}
class Computation {
    steps;
    parameter;
    sizeOf;
    depths;
    constant = new Map();
    constructor(steps, parameter, sizeOf) {
        this.steps = steps;
        this.parameter = parameter;
        this.sizeOf = sizeOf;
        this.depths = depthsOf(steps);
    }
    /** The value of a step; `bound` are the variables around it, the innermost first. */
    body(last, bound) {
        const varying = new Map();
        const valuesOf = (number) => (this.depths[number] ? varying : this.constant);
        for (const number of this.needed(last)) {
            const row = this.steps[number];
            const operands = outside(row).map((each) => valuesOf(each).get(each));
            valuesOf(number).set(number, this.step(row, operands, bound));
        }
        return valuesOf(last).get(last);
    }
    /** The steps that one needs and that are not known, in their order. */
    needed(last) {
        const found = new Set();
        const pending = [last];
        for (let number = pending.pop(); number !== undefined; number = pending.pop()) {
            if (found.has(number) || this.constant.has(number))
                continue;
            found.add(number);
            pending.push(...outside(this.steps[number]));
        }
        return [...found].sort((a, b) => a - b);
    }
    step(row, operands, bound) {
        const values = operands;
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
    fold(row, [[count], start], bound) {
        let result = start;
        for (let turn = 0; turn < Math.min(count, row.bound); turn++) {
            const value = this.body(row.args[2], [[turn], ...bound]);
            result = evaluate(row.operator, [result, value], kindOf(row.type));
        }
        return result;
    }
}
/** The value of a builtin; `kind` is the type of the operands' lanes. */
export function evaluate(name, operands, kind) {
    const shapes = operands.map((each) => Array.isArray(each[0]) ? `${each.length}x${each[0].length}` : each.length);
    const whole = WHOLE[[name, kind, ...shapes].join(" ")];
    if (whole)
        return whole(...operands);
    const lanewise = LANEWISE[`${name} ${kind}`];
    if (!lanewise)
        throw new Error(`this host does not know the function ${name} of ${kind}`);
    const lanes = operands;
    return Array.from({ length: Math.max(...lanes.map((each) => each.length)) }, (_, at) => lanewise(...lanes.map((each) => each[each.length === 1 ? 0 : at])));
}
/** An element or a member of a value; a number is one lane. */
function partOf(value, key) {
    const part = value[key];
    return typeof part === "number" ? [part] : part;
}
/** The arguments that are not a body under the step's binder. */
function outside(row) {
    if (row.op === "fold")
        return row.args.slice(0, 2);
    return row.op === "apply" ? row.args.slice(1) : row.args;
}
/** For each step, how many of the binders around it bind a variable that it uses. */
function depthsOf(steps) {
    const depths = [];
    for (const row of steps) {
        let depth = Math.max(0, ...outside(row).map((each) => depths[each]));
        if (row.op === "bound")
            depth = row.binder + 1;
        if (row.op === "fold")
            depth = Math.max(depth, depths[row.args[2]] - 1);
        if (row.op === "apply")
            depth = Math.max(depth, depths[row.args[0]] - row.args.length + 1);
        depths.push(depth);
    }
    return depths;
}
function constantOf(value) {
    const lanes = Array.isArray(value) ? value : [value];
    return lanes.map((lane) => (Array.isArray(lane) ? lane.map(Number) : Number(lane)));
}
/** The type of the lanes of a number, vector or matrix. */
export function kindOf(type) {
    if (type === "int" || type === "uint" || type === "bool")
        return type;
    const kinds = { ivec: "int", uvec: "uint", bvec: "bool" };
    return kinds[type.slice(0, 4)] ?? "float";
}
