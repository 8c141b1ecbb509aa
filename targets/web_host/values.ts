// Named values of a frame or a shader, and the bytes of uniform blocks that they become.

import { compute, kindOf, type Datum, type Inputs } from "./steps.js";
import type {
  BufferRow, Derived, LightRow, Operation, Parameter, Placed, Value,
} from "./types.js";

/** What of a plan or a reflection says which values there are. */
export interface Declarations {
  parameters: Parameter[];
  lights: LightRow[];
  buffers: BufferRow[];
  blocks: { name: string; size: number }[];
  derived: Derived[];
}

const UNIT_TYPES = /^(direction|normal)\b/;
const UNIT_TOLERANCE = 1e-3;

/** The values of one shader, or of a frame. They begin with the declared defaults. */
export class Values {
  private readonly rows = new Map<string, Parameter>();
  private known = new Map<string, Datum | null>();

  constructor(
    /** What has these values, for messages. */
    readonly name: string,
    readonly declared: Declarations,
  ) {
    for (const row of declared.parameters) {
      this.rows.set(row.name, row);
      const first = row.count ? accepted(row, row.default, null, row.name) : initial(row);
      this.known.set(row.name, first);
    }
  }

  /** Values of their own, which can be changed by themselves. */
  copied(): Values {
    const made: Values = Object.create(Values.prototype, Object.getOwnPropertyDescriptors(this));
    made.known = new Map(this.known);
    return made;
  }

  /** Whether there is something of this name: a parameter, a part of one, or a light. */
  has(name: string): boolean {
    return this.parameterOf(name) !== undefined || this.lightOf(name) !== undefined;
  }

  /** Set a parameter, a part of one, or a light. */
  set(name: string, value: Value): void {
    const row = this.parameterOf(name);
    if (row) {
      const path = name.slice(row.name.length).match(/\w+/g) ?? [];
      this.known.set(row.name, changed(row, this.known.get(row.name)!, path, value, name));
      const isList = row.count && !path.length && Array.isArray(value);
      if (isList) this.known.set(row.count!, [value.length]);
      return;
    }
    if (!this.lightOf(name)) throw new Error(`${this.name} has no parameter \`${name}\``);
    for (const [member, part] of Object.entries(value ?? {})) {
      this.set(`${name}.${member}`, part);
    }
  }

  /** Take over the whole value of a parameter from others, where it has this type. */
  take(name: string, other: Values, source: string): void {
    this.known.set(name, other.known.get(source)!);
  }

  /** Say how many elements a storage buffer has. */
  count(buffer: BufferRow, bytes: number): void {
    this.known.set(buffer.count, [Math.floor(bytes / buffer.stride)]);
  }

  /** A value as it is stored. An error if somebody has yet to set it. */
  get(name: string): Datum {
    const row = this.parameterOf(name);
    let found: any = row && this.known.get(row.name);
    for (const step of row ? name.slice(row.name.length).match(/\w+/g) ?? [] : []) {
      found = found?.[step];
    }
    if (found === undefined || found === null) {
      throw new Error(`${this.name} needs a value for \`${name}\``);
    }
    return found;
  }

  /** The value that steps compute. `sizes` are those of the textures that they read. */
  evaluated(steps: Operation[], sizes: Inputs["size"], element?: number): Datum {
    return compute(steps, { parameter: (name) => this.get(name), size: sizes }, element);
  }

  /** The number that steps compute of these values alone. */
  number(steps: Operation[]): number {
    return (this.evaluated(steps, noTexture) as number[])[0];
  }

  /** The bytes of every block, those of derived values included. */
  blocks(): Map<string, Uint8Array<ArrayBuffer>> {
    const { blocks, parameters, derived } = this.declared;
    const found = new Map<string, DataView<ArrayBuffer>>();
    for (const { name, size } of blocks) found.set(name, new DataView(new ArrayBuffer(size)));
    for (const row of parameters) {
      if (row.block !== null) write(found.get(row.block)!, row.offset!, row, this.get(row.name));
    }
    for (const row of derived) {
      write(found.get(row.block)!, row.offset, row, this.derivedOf(row));
    }
    return new Map([...found].map(([name, { buffer }]) => [name, new Uint8Array(buffer)]));
  }

  private derivedOf({ steps, layout: { count } }: Derived): Datum {
    if (count === undefined) return this.evaluated(steps, noTexture);
    return Array.from({ length: count }, (_, at) => this.evaluated(steps, noTexture, at));
  }

  private parameterOf(name: string): Parameter | undefined {
    for (let end = name.length; end > 0; end = name.slice(0, end).search(/[.[][^.[]*$/)) {
      const row = this.rows.get(name.slice(0, end));
      if (row) return row;
    }
    return undefined;
  }

  private lightOf(name: string): LightRow | undefined {
    return this.declared.lights.find((each) => each.name === name && each.capacity === null);
  }
}

const noTexture = (name: string) => {
  throw new Error(`the size of the texture \`${name}\` is not known here`);
};

// --- shapes --------------------------------------------------------------------------------------

/** The row of one element of an array. */
function elementOf(row: Placed): Placed {
  const { count: _, ...layout } = row.layout;
  const one = (type = "") => type.replace(/\[[^[]*\]$/, "");
  return { ...row, type: one(row.type), representation: one(row.representation), layout };
}

/** What a host means by a value. Parts that it leaves out, or that are null, stay as they were, and
 * are their defaults or zero at first. */
function accepted(row: Placed, value: Value, old: Datum | null, name: string): Datum {
  const { count, columns, lanes } = row.layout;
  if (count !== undefined) {
    const isCounted = Boolean((row as Partial<Parameter>).count);
    const items = value === null ? [] : listed(value, name, count, isCounted);
    const element = elementOf(row);
    return Array.from({ length: count }, (_, at) =>
      accepted(element, items[at] ?? null, (old as Datum[] | null)?.[at] ?? null, `${name}[${at}]`),
    );
  }
  if (row.members?.length) {
    const before = old as { [member: string]: Datum } | null;
    return Object.fromEntries(
      row.members.map((each, at) => {
        const part = (value as any)?.[Array.isArray(value) ? at : each.name] ?? null;
        const first = before ? before[each.name] : initial(each);
        return [each.name, accepted(each, part, first, `${name}.${each.name}`)];
      }),
    );
  }
  const zero = Array(lanes).fill(0);
  if (value === null) return old ?? (columns ? Array(columns).fill(zero) : zero);
  if (!columns) return vector(row, value, name);
  return listed(value, name, columns, false).map((column) => vector(row, column, name));
}

/** The declared default of a member, if it has one. */
function initial(row: Placed): Datum | null {
  const value = (row as Partial<Parameter>).default ?? null;
  return value === null ? null : accepted(row, value, null, row.name);
}

/** `old` with the part at a path replaced. */
function changed(
  row: Placed, old: Datum | null, path: string[], value: Value, name: string,
): Datum {
  if (!path.length) return accepted(row, value, old, name);
  const [step, ...further] = path;
  const inArray = row.layout.count !== undefined;
  const part = inArray
    ? Number(step) < row.layout.count! && elementOf(row)
    : row.members?.find((each) => each.name === step);
  if (!part) throw new Error(`\`${row.name}\` has no part \`${step}\``);
  const made: any = accepted(row, null, old, name);
  const inner = changed(part, made[step], further, value, name);
  return Object.assign(inArray ? [...made] : { ...made }, { [step]: inner });
}

function listed(value: Value, name: string, count: number, orFewer: boolean): Value[] {
  const length = Array.isArray(value) ? value.length : Infinity;
  if (length === count || (orFewer && length < count)) return value as Value[];
  throw new Error(`\`${name}\` takes ${count} elements`);
}

function vector(row: Placed, value: Value, name: string): number[] {
  const plain = (lane: Value) => (typeof lane === "boolean" ? Number(lane) : lane);
  const given = (Array.isArray(value) ? value : [value]).map(plain);
  const { lanes: count, columns } = row.layout;
  const refuse = (why: string) => new Error(`\`${name}\` ${why}`);
  if (given.length !== count || given.some((lane) => typeof lane !== "number")) {
    throw refuse(`(${row.type}) takes ${count === 1 ? "one number" : `${count} numbers`}`);
  }
  const isFloat = kindOf(row.representation) === "float";
  const lanes = (given as number[]).map((lane) => (isFloat ? Math.fround(lane) : lane));
  const [low, high] = (row as Partial<Parameter>).range ?? [-Infinity, Infinity];
  for (const lane of lanes) {
    if (!Number.isFinite(lane)) throw refuse("takes finite numbers");
    if (!isFloat && !Number.isInteger(lane)) throw refuse("takes whole numbers");
    if (lane < Math.fround(low) || lane > Math.fround(high)) {
      throw refuse(`is declared in ${low}..${high}: ${lane} is not`);
    }
  }
  if (count > 1 && !columns && UNIT_TYPES.test(row.type ?? "")) {
    const length = Math.hypot(...lanes);
    if (Math.abs(length - 1) > UNIT_TOLERANCE) throw refuse(`has to be of length 1, not ${length}`);
  }
  return lanes;
}

// --- bytes ---------------------------------------------------------------------------------------

/** Write a value where its row says that it lies, `offset` bytes from the start. */
export function write(view: DataView, offset: number, row: Placed, value: Datum): void {
  const { count, stride, columns, column_stride, kind } = row.layout;
  if (count !== undefined) {
    const element = elementOf(row);
    (value as Datum[]).forEach((part, at) => write(view, offset + at * stride!, element, part));
  } else if (row.members?.length) {
    for (const each of row.members) {
      write(view, offset + each.offset, each, (value as { [member: string]: Datum })[each.name]);
    }
  } else if (columns) {
    (value as number[][]).forEach((column, at) => {
      writeLanes(view, offset + at * column_stride!, kind, column);
    });
  } else {
    writeLanes(view, offset, kind, value as number[]);
  }
}

function writeLanes(view: DataView, offset: number, kind: string, lanes: number[]): void {
  lanes.forEach((lane, at) => {
    if (kind === "float") view.setFloat32(offset + 4 * at, lane, true);
    else view.setInt32(offset + 4 * at, lane | 0, true);
  });
}
