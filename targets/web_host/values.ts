// Named values of a frame or a shader, and the bytes of uniform blocks that they become.

import type { DerivedRow, MemberRow, ParameterRow, Reflection, Value } from "./generated/documents.js";
import { compute, kindOf, type Datum, type SizeOf, type Step } from "./steps.js";

/** What of a plan or a reflection says which values there are. */
export type Declarations =
  Pick<Reflection, "parameters" | "lights" | "buffers" | "blocks" | "derived">;

/** A value, and where its lanes are. */
type Placed = Pick<MemberRow, "name" | "representation" | "layout"> &
  Partial<Pick<ParameterRow, "type" | "members" | "default" | "range" | "count">>;

/** A vector, or the columns of a matrix. */
type Lanes = number[] | number[][];

const UNIT_TYPES = /^(direction|normal)\b/;
const UNIT_TOLERANCE = 1e-3;

/** The values of one shader, or of a frame. They begin with the declared defaults. */
export class Values {
  private readonly rows = new Map<string, ParameterRow>();
  /** Of all parts of parameters that have no parts themselves. */
  private lanes = new Map<string, Lanes>();
  /** The parameters that have a value. */
  private known = new Set<string>();

  constructor(
    /** What has these values, for messages. */
    readonly name: string,
    readonly declared: Declarations,
  ) {
    for (const row of declared.parameters) {
      this.rows.set(row.name, row);
      for (const [name, lanes] of defaults(row, row.name)) this.lanes.set(name, lanes);
      if (row.count || row.default !== null) this.known.add(row.name);
    }
  }

  /** Values of their own, which can be changed by themselves. */
  copied(): Values {
    const made: Values = Object.create(Values.prototype, Object.getOwnPropertyDescriptors(this));
    made.lanes = new Map(this.lanes);
    made.known = new Set(this.known);
    return made;
  }

  /** Whether there is something of this name: a parameter, a part of one, or a light. */
  has(name: string): boolean {
    return Boolean(this.find(name) ?? this.lightOf(name));
  }

  /** Set a parameter, a part of one, or a light. Parts that are left out, or null, stay as they
   * were, and are their defaults or zero at first. */
  set(name: string, value: Value): void {
    const found = this.find(name);
    if (found) {
      const { parameter, part } = found;
      // All of it, or nothing.
      for (const [each, lanes] of [...accepted(part, value)]) this.lanes.set(each, lanes);
      this.known.add(parameter.name);
      const isList = part.row === parameter && Array.isArray(value);
      if (isList && parameter.count) this.set(parameter.count, value.length);
      return;
    }
    if (!this.lightOf(name)) throw new Error(`${this.name} has no parameter \`${name}\``);
    for (const [member, part] of Object.entries(value ?? {})) this.set(`${name}.${member}`, part);
  }

  /** Say how many elements a storage buffer has. */
  count(buffer: Declarations["buffers"][number], bytes: number): void {
    this.set(buffer.count, Math.floor(bytes / buffer.stride));
  }

  /** A value as it is stored. An error if somebody has yet to set it. */
  get(name: string): Datum {
    const found = this.find(name);
    if (!found || !this.known.has(found.parameter.name)) {
      throw new Error(`${this.name} needs a value for \`${name}\``);
    }
    return this.whole(found.part);
  }

  private whole({ row, name }: Part): Datum {
    const parts = partsOf(row, name);
    if (!parts.length) return this.lanes.get(name)!;
    if (row.layout.count !== undefined) return parts.map((each) => this.whole(each));
    return Object.fromEntries(parts.map((each) => [each.key, this.whole(each)]));
  }

  /** The value that steps compute. `size` tells the sizes of the textures that they read. */
  evaluated(steps: Step[], size: SizeOf = noTexture, element?: number): Datum {
    return compute(steps, (name) => this.get(name), size, element);
  }

  /** The bytes of every block, those of derived values included. */
  blocks(): Map<string, Uint8Array<ArrayBuffer>> {
    const { blocks, parameters, derived } = this.declared;
    const found = new Map(blocks.map(({ name, size }) => [name, new ArrayBuffer(size)]));
    const put = (row: ParameterRow | DerivedRow, value: () => Datum) => {
      if (row.block !== null) write(new DataView(found.get(row.block)!), row.offset!, row, value());
    };
    for (const row of parameters) put(row, () => this.get(row.name));
    for (const row of derived) put(row, () => this.derivedOf(row));
    return new Map([...found].map(([name, buffer]) => [name, new Uint8Array(buffer)]));
  }

  private derivedOf({ steps, layout: { count } }: DerivedRow): Datum {
    if (count === undefined) return this.evaluated(steps);
    return Array.from({ length: count }, (_, at) => this.evaluated(steps, noTexture, at));
  }

  /** What a name means: a parameter, or a part of one. */
  private find(name: string): { parameter: ParameterRow; part: Part } | undefined {
    for (let end = name.length; end > 0; end = name.slice(0, end).search(/[.[][^.[]*$/)) {
      const parameter = this.rows.get(name.slice(0, end));
      if (!parameter) continue;
      const path: string[] = name.slice(end).match(/\w+/g) ?? [];
      return { parameter, part: path.reduce(partOf, { row: parameter, name: parameter.name }) };
    }
    return undefined;
  }

  private lightOf(name: string) {
    return this.declared.lights.find((each) => each.name === name && each.capacity === null);
  }
}

const noTexture = (name: string) => {
  throw new Error(`the size of the texture \`${name}\` is not known here`);
};

// --- parts ---------------------------------------------------------------------------------------

/** A value, or an element or member of one, with its whole name. */
interface Part { row: Placed; name: string }

/** The elements or members of a value, if it has any, each with its offset in it. */
function partsOf(row: Placed, name: string): (Part & { key: string | number; offset: number })[] {
  const { count, stride, ...layout } = row.layout;
  if (count === undefined) {
    return (row.members ?? []).map((each) => {
      return { key: each.name, row: each, name: `${name}.${each.name}`, offset: each.offset };
    });
  }
  const one = (type = "") => type.replace(/\[[^[]*\]$/, "");
  const element: Placed = {
    name: row.name, type: one(row.type), representation: one(row.representation), layout,
    members: row.members, range: row.range,
  };
  return Array.from({ length: count }, (_, key) => {
    return { key, row: element, name: `${name}[${key}]`, offset: key * stride! };
  });
}

function partOf({ row, name }: Part, step: string): Part {
  const found = partsOf(row, name).find(({ key }) => `${key}` === step);
  if (!found) throw new Error(`\`${row.name}\` has no part \`${step}\``);
  return found;
}

/** The lanes of all parts of a value: zero, or what is declared for a part or for all of them. */
function* defaults(row: Placed, name: string): Generator<[string, Lanes]> {
  const parts = partsOf(row, name);
  for (const each of parts) yield* defaults(each.row, each.name);
  const { columns, lanes } = row.layout;
  const zero = Array(lanes).fill(0);
  if (!parts.length) yield [name, columns ? Array(columns).fill(zero) : zero];
  if ((row.default ?? null) !== null) yield* accepted({ row, name }, row.default!);
}

/** The lanes that a host means by a value, for each part that it gives. */
function* accepted({ row, name }: Part, value: Value): Generator<[string, Lanes]> {
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
    const given = Array.isArray(value) ? value[at] : (value as Record<string, Value>)[each.key];
    yield* accepted(each, given ?? null);
  }
}

function check(value: Value, name: string, count: number, orFewer = false): Value[] {
  const length = Array.isArray(value) ? value.length : Infinity;
  if (length === count || (orFewer && length < count)) return value as Value[];
  throw new Error(`\`${name}\` takes ${count} elements`);
}

function vector({ layout, type = "", representation, range }: Placed, value: Value, name: string) {
  const given = [value].flat().map((lane) => (typeof lane === "boolean" ? Number(lane) : lane));
  const { lanes: count, columns } = layout;
  const refuse = (why: string) => new Error(`\`${name}\` ${why}`);
  if (given.length !== count || given.some((lane) => typeof lane !== "number")) {
    throw refuse(`(${type}) takes ${count === 1 ? "one number" : `${count} numbers`}`);
  }
  const isFloat = kindOf(representation) === "float";
  const lanes = (given as number[]).map((lane) => (isFloat ? Math.fround(lane) : lane));
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

/** Write a value where its row says that it lies, `offset` bytes from the start. */
function write(view: DataView, offset: number, row: Placed, value: Datum): void {
  const parts = partsOf(row, "");
  for (const each of parts) {
    write(view, offset + each.offset, each.row, (value as Record<string, Datum>)[each.key]);
  }
  if (parts.length) return;
  const { columns, column_stride, kind } = row.layout;
  const vectors = (columns ? value : [value]) as number[][];
  vectors.forEach((lanes, column) => lanes.forEach((lane, at) => {
    const place = offset + column * (column_stride ?? 0) + 4 * at;
    if (kind === "float") view.setFloat32(place, lane, true);
    else view.setInt32(place, lane | 0, true);
  }));
}
