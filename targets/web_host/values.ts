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

/** A value, with null for parts that nobody has set. */
type Known = Datum | null;

const UNIT_TYPES = /^(direction|normal)\b/;
const UNIT_TOLERANCE = 1e-3;

/** The values of one shader, or of a frame. They begin with the declared defaults. */
export class Values {
  private readonly rows = new Map<string, Parameter>();
  private known = new Map<string, Known>();

  constructor(
    /** What has these values, for messages. */
    readonly name: string,
    readonly declared: Declarations,
  ) {
    for (const row of declared.parameters) {
      this.rows.set(row.name, row);
      this.known.set(row.name, initial(row, row.default));
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
      if (row.count && !path.length && Array.isArray(value)) this.known.set(row.count, [value.length]);
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
    return compute(steps, { parameter: (name) => this.filled(name), size: sizes }, element);
  }

  /** The bytes of every block, those of derived values included. */
  blocks(): Map<string, Uint8Array<ArrayBuffer>> {
    const { blocks, parameters, derived } = this.declared;
    const found = new Map(blocks.map(({ name, size }) => [name, new DataView(new ArrayBuffer(size))]));
    for (const row of parameters) {
      if (row.block !== null) write(found.get(row.block)!, row.offset!, row, this.filled(row.name));
    }
    for (const row of derived) {
      write(found.get(row.block)!, row.offset, row, this.derivedOf(row));
    }
    return new Map([...found].map(([name, { buffer }]) => [name, new Uint8Array(buffer)]));
  }

  private derivedOf({ name, steps, layout }: Derived): Datum {
    const none = () => {
      throw new Error(`${name} of ${this.name} depends on the size of a texture`);
    };
    if (layout.count === undefined) return this.evaluated(steps, none);
    return Array.from({ length: layout.count }, (_, at) => this.evaluated(steps, none, at));
  }

  /** A value with zeros for the parts that nobody has set, if there is a part that somebody has. */
  private filled(name: string): Datum {
    return zeroed(this.rows.get(name)!, this.get(name));
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

// --- shapes --------------------------------------------------------------------------------------

/** The row of one element of an array. */
function elementOf(row: Placed): Placed {
  const { count: _, ...layout } = row.layout;
  const type = row.type?.replace(/\[[^[]*\]$/, "");
  return { ...row, type, representation: row.representation.replace(/\[[^[]*\]$/, ""), layout };
}

function initial(row: Placed, value: Value): Known {
  if (row.layout.count !== undefined) {
    const element = elementOf(row);
    const parts = value as Value[] | null;
    return Array.from({ length: row.layout.count }, (_, at) => initial(element, parts?.[at] ?? null)) as Datum[];
  }
  if (row.members?.length) {
    const parts = value as Value[] | null;
    return Object.fromEntries(
      row.members.map((each, at) => [
        each.name,
        initial(each, parts?.[at] ?? (each as Partial<Parameter>).default ?? null),
      ]),
    ) as Datum;
  }
  return value === null ? null : accepted(row, value, null, row.name);
}

/** `old` with the part at a path replaced. */
function changed(row: Placed, old: Known, path: string[], value: Value, name: string): Known {
  if (!path.length) return accepted(row, value, old, name);
  const [step, ...further] = path;
  const part = row.layout.count !== undefined
    ? Number(step) < row.layout.count && elementOf(row)
    : row.members?.find((each) => each.name === step);
  if (!part) throw new Error(`\`${row.name}\` has no part \`${step}\``);
  const before = old as any;
  const inner = changed(part, before[step], further, value, name);
  return Array.isArray(before)
    ? before.map((each, at) => (at === Number(step) ? inner : each))
    : { ...before, [step]: inner };
}

/** What a host means by a value. Parts that are null, or that are missing, stay as they were. */
function accepted(row: Placed, value: Value, old: Known, name: string): Known {
  if (value === null) return old;
  const { count, columns } = row.layout;
  if (count !== undefined) {
    const counted = Boolean((row as Partial<Parameter>).count);
    const items = listed(value, name, (length) => length <= count && (counted || length === count), `${count} elements`);
    const element = elementOf(row);
    return (old as Known[]).map((before, at) =>
      at < items.length ? accepted(element, items[at], before, `${name}[${at}]`) : before,
    ) as Datum[];
  }
  if (row.members?.length) {
    const parts = value as { [member: string]: Value };
    return Object.fromEntries(
      row.members.map((each) => [
        each.name,
        accepted(each, parts[each.name] ?? null, (old as any)[each.name], `${name}.${each.name}`),
      ]),
    ) as Datum;
  }
  if (columns) {
    return listed(value, name, (length) => length === columns, `${columns} columns`).map((column) =>
      vector(row, column, name),
    );
  }
  return vector(row, value, name);
}

function listed(value: Value, name: string, fits: (length: number) => boolean, wanted: string): Value[] {
  if (Array.isArray(value) && fits(value.length)) return value;
  throw new Error(`\`${name}\` takes ${wanted}`);
}

function vector(row: Placed, value: Value, name: string): number[] {
  const count = row.layout.lanes;
  const given = Array.isArray(value) ? value : [value];
  if (given.length !== count || given.some((lane) => typeof lane !== "number" && typeof lane !== "boolean")) {
    throw new Error(`\`${name}\` (${row.type}) takes ${count === 1 ? "one number" : `${count} numbers`}`);
  }
  const kind = kindOf(row.representation);
  const lanes = given.map((lane) => (kind === "float" ? Math.fround(Number(lane)) : Number(lane)));
  const range = (row as Partial<Parameter>).range;
  for (const lane of lanes) {
    if (!Number.isFinite(lane)) throw new Error(`\`${name}\` takes finite numbers`);
    if (range && !(lane >= Math.fround(range[0]) && lane <= Math.fround(range[1]))) {
      throw new Error(`\`${name}\` is declared in ${range[0]}..${range[1]}: ${lane} is not`);
    }
    if (kind !== "float" && !Number.isInteger(lane)) throw new Error(`\`${name}\` takes whole numbers`);
  }
  if (count > 1 && !row.layout.columns && UNIT_TYPES.test(row.type ?? "")) {
    const length = Math.hypot(...lanes);
    if (Math.abs(length - 1) > UNIT_TOLERANCE) throw new Error(`\`${name}\` has to be of length 1, not ${length}`);
  }
  return lanes;
}

function zeroed(row: Placed, value: Known): Datum {
  if (row.layout.count !== undefined) {
    const element = elementOf(row);
    return (value as Known[]).map((part) => zeroed(element, part)) as Datum[];
  }
  if (row.members?.length) {
    return Object.fromEntries(row.members.map((each) => [each.name, zeroed(each, (value as any)[each.name])]));
  }
  const column = Array(row.layout.lanes).fill(0);
  return value ?? (row.layout.columns ? Array(row.layout.columns).fill(column) : column);
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
    (value as number[][]).forEach((column, at) => writeLanes(view, offset + at * column_stride!, kind, column));
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
