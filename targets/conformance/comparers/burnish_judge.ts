// SPDX-License-Identifier: Apache-2.0

/**
 * Judges pictures by the bounds of a golden folder. Copy this file into your own test suite.
 *
 * `burnish conform FILE --golden FOLDER` writes a golden folder: for each case, and each output of
 * it, the lowest and the highest value that a conforming device may draw at each pixel. This file
 * needs nothing else, in browsers and in Node 18 or newer, and comes in Python, Rust, TypeScript
 * and C++, with the same names and the same verdicts. A test loads the bounds, draws, and asks for
 * the verdict:
 *
 *     const bounds = await Bounds.load("golden/Plastic/defaults", "color", readFile);
 *     const picture = new Picture(72, 56, 4, pixels);
 *     const verdict = judge(bounds, picture, "srgb");
 *     if (!verdict.isGood) throw new Error(verdict.message);
 *
 * Here `readFile` is that of `node:fs/promises`. In a browser, it is a function that fetches:
 *
 *     const readFile = async (path: string) => (await fetch(path)).arrayBuffer();
 */

/** Nothing can be judged: a damaged file, a picture of another size, or nothing to compare. */
export class JudgeError extends Error {
  override readonly name = "JudgeError";
}

/**
 * The way in which a picture of integers has values; pictures of floats have them as such.
 *
 * - `linear`: a value is its code divided by the largest code.
 * - `srgb`: the first three lanes have the transfer function of sRGB; the fourth, alpha, is linear.
 */
export type Encoding = "linear" | "srgb";

/** The numbers of a picture. */
export type Samples = Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array | Float64Array;

/** The content of a file. */
export type Bytes = ArrayBuffer | Uint8Array;

/** Reads a file, as `readFile` of `node:fs/promises` does. */
export type Read = (path: string) => Promise<Bytes>;

/** A picture in memory: row by row from the top, with the lanes of each pixel side by side. */
export class Picture {
  readonly width: number;
  readonly height: number;
  readonly lanes: number;
  readonly data: Samples;

  constructor(width: number, height: number, lanes: number, data: Samples) {
    this.width = width;
    this.height = height;
    this.lanes = lanes;
    this.data = data;
  }

  /** The picture in a `.npy` file: (height, width) or (height, width, lanes). */
  static async load(path: string, read: Read): Promise<Picture> {
    return Picture.of(await Npy.load(path, read));
  }

  /** The picture in the bytes of a `.npy` file. */
  static parse(content: Bytes): Picture {
    return Picture.of(Npy.parse("picture.npy", content));
  }

  private static of(file: Npy): Picture {
    return new Picture(file.width, file.height, file.lanes, file.numbers);
  }
}

/** The values that a conforming device may draw, for one output of a case. */
export class Bounds {
  readonly width: number;
  readonly height: number;
  readonly lanes: number;
  /** The lowest value of each lane of each pixel, in the order of `Picture.data`. */
  readonly lower: Samples;
  /** The highest value, likewise. */
  readonly upper: Samples;
  /** For each pixel, 1 if it is not compared, else 0. */
  readonly undecided: Samples;

  private constructor(lower: Npy, upper: Npy, undecided: Npy) {
    const { width, height, lanes } = lower;
    lower.expect("<f8", width, height, lanes);
    upper.expect("<f8", width, height, lanes);
    undecided.expect("|u1", width, height, 1);
    const mark = undecided.numbers.find((each) => each > 1);
    if (mark !== undefined) {
      throw new JudgeError(`${undecided.name}: is damaged: it has a ${mark}, not just 0 and 1`);
    }
    for (const [index, low] of lower.numbers.entries()) {
      const high = upper.numbers[index]!;
      if (!(low <= high)) {
        const [pixel, lane] = [Math.floor(index / lanes), index % lanes];
        const place = `x ${pixel % width}, y ${Math.floor(pixel / width)}, lane ${lane}`;
        const found = `lower is ${shown(low)}, upper ${shown(high)}`;
        throw new JudgeError(`${lower.name}: is damaged at ${place}: ${found}`);
      }
    }
    [this.width, this.height, this.lanes] = [width, height, lanes];
    this.lower = lower.numbers;
    this.upper = upper.numbers;
    this.undecided = undecided.numbers;
  }

  /** The bounds in the folder of a case, `golden/Plastic/defaults`, for one output. */
  static async load(folder: string, output: string, read: Read): Promise<Bounds> {
    return new Bounds(
      await Npy.load(`${folder}/${output}.lower.npy`, read),
      await Npy.load(`${folder}/${output}.upper.npy`, read),
      await Npy.load(`${folder}/undecided.npy`, read),
    );
  }

  /** The bounds in the bytes of the three files. */
  static parse(lower: Bytes, upper: Bytes, undecided: Bytes): Bounds {
    return new Bounds(
      Npy.parse("lower.npy", lower),
      Npy.parse("upper.npy", upper),
      Npy.parse("undecided.npy", undecided),
    );
  }
}

/** A lane of a pixel that is outside of its bounds, counted from 0 at the left and the top. */
export interface Outlier {
  readonly x: number;
  readonly y: number;
  readonly lane: number;
  /** The number as the picture has it: of a picture of integers, the code. */
  readonly value: number;
  /** The lowest number that it may be: of a picture of integers, a code. */
  readonly lower: number;
  /** The highest number, likewise. */
  readonly upper: number;
  /** The distance to the nearer end, for codes divided by the largest one. It is infinite for a NaN. */
  readonly distance: number;
}

/** The result of a comparison, in pixels. */
export class Verdict {
  readonly compared: number;
  readonly undecided: number;
  readonly outside: number;
  /** The lane that is farthest outside. Of equally far ones, it is the first in the rows. */
  readonly worst: Outlier | undefined;

  constructor(compared: number, undecided: number, outside: number, worst: Outlier | undefined) {
    this.compared = compared;
    this.undecided = undecided;
    this.outside = outside;
    this.worst = worst;
  }

  /** True if no pixel is outside of its bounds. */
  get isGood(): boolean {
    return this.outside === 0;
  }

  /** The verdict in one line. */
  get message(): string {
    const { compared, undecided, outside, worst } = this;
    const counts =
      `${compared} pixels compared, ${undecided} undecided, ${outside} outside of the bounds`;
    if (worst === undefined) return `good: ${counts}`;
    const place = `x ${worst.x}, y ${worst.y}, lane ${worst.lane}`;
    const range = `${shown(worst.lower)} .. ${shown(worst.upper)}`;
    return `bad: ${counts}; the worst, at ${place}, is ${shown(worst.value)}, not within ${range}`;
  }
}

/** Compares a picture with the bounds. Throws a `JudgeError` if that is not possible. */
export function judge(bounds: Bounds, picture: Picture, encoding: Encoding = "linear"): Verdict {
  checkShape(bounds, picture);
  const largest = largestCode(picture.data);
  if (largest === undefined && encoding === "srgb") {
    throw new JudgeError("the picture has floats, which are linear: only integers are encoded");
  }
  let [compared, outside] = [0, 0];
  let worst: Outlier | undefined;
  for (let pixel = 0; pixel < bounds.undecided.length; pixel++) {
    if (bounds.undecided[pixel]) continue;
    compared++;
    let isOutside = false;
    for (let lane = 0; lane < picture.lanes; lane++) {
      const at = pixel * bounds.lanes + lane;
      let [lower, upper] = [bounds.lower[at]!, bounds.upper[at]!];
      if (largest !== undefined) {
        const isSrgb = encoding === "srgb" && lane < 3;
        [lower, upper] = codes(lower, upper, largest, isSrgb);
      }
      const value = picture.data[pixel * picture.lanes + lane]!;
      if (lower <= value && value <= upper) continue;
      isOutside = true;
      const distance = distanceOf(value, lower, upper) / (largest ?? 1);
      if (worst === undefined || distance > worst.distance) {
        const [x, y] = [pixel % bounds.width, Math.floor(pixel / bounds.width)];
        worst = { x, y, lane, value, lower, upper, distance };
      }
    }
    if (isOutside) outside++;
  }
  if (compared === 0) throw new JudgeError("nothing is compared: every pixel is undecided");
  return new Verdict(compared, bounds.undecided.length - compared, outside, worst);
}

// How numbers are compared.

/** Throws a `JudgeError` for a picture that does not fit the bounds. */
function checkShape(bounds: Bounds, picture: Picture): void {
  const { width, height, lanes, data } = picture;
  if (width !== bounds.width || height !== bounds.height) {
    const expected = `the bounds have ${bounds.width} x ${bounds.height}`;
    throw new JudgeError(`the picture has ${width} x ${height} pixels, but ${expected}`);
  }
  if (!(1 <= lanes && lanes <= bounds.lanes)) {
    throw new JudgeError(`the picture has ${lanes} lanes, but the bounds have ${bounds.lanes}`);
  }
  const expected = width * height * lanes;
  if (data.length !== expected) {
    throw new JudgeError(`the picture has ${data.length} numbers, but its size needs ${expected}`);
  }
}

/** The largest code of integers; floats have none. */
function largestCode(data: Samples): number | undefined {
  const type = data[Symbol.toStringTag]; // Test frameworks have arrays that are not `instanceof`.
  if (!LARGEST.has(type)) throw new JudgeError(`the picture has numbers of type ${type}`);
  return LARGEST.get(type);
}

const LARGEST = new Map<string, number | undefined>([
  ["Uint8Array", 255],
  ["Uint8ClampedArray", 255],
  ["Uint16Array", 65535],
  ["Float32Array", undefined],
  ["Float64Array", undefined],
]);

/** The codes that bounds allow: a format may round a value to either neighbour. */
function codes(lower: number, upper: number, largest: number, isSrgb: boolean): [number, number] {
  const encoded = (end: number): number => {
    const clamped = Math.min(Math.max(end, 0), 1);
    return largest * (isSrgb ? srgb(clamped) : clamped);
  };
  return [Math.floor(encoded(lower)), Math.ceil(encoded(upper))];
}

/** The transfer function of sRGB (IEC 61966-2-1), from linear light. */
function srgb(value: number): number {
  return value <= 0.0031308 ? 12.92 * value : 1 + 1.055 * (value ** (1 / 2.4) - 1);
}

/** The distance of a value that is outside to the nearer end. */
function distanceOf(value: number, lower: number, upper: number): number {
  if (Number.isNaN(value)) return Infinity;
  return value < lower ? lower - value : value - upper;
}

// How numbers are shown: in all four languages alike.

/** The shortest decimal that means the same number. */
function shown(number: number): string {
  const magnitude = Math.abs(number);
  if (magnitude === Infinity) return number < 0 ? "-inf" : "inf";
  const isShort = 1e-4 <= magnitude && magnitude < 1e16;
  if (isShort || magnitude === 0 || Number.isNaN(number)) return String(number);
  return number.toExponential().replace("e+", "e");
}

// The format `.npy` of NumPy, as far as pictures need it.

const LONGEST_SIDE = 65536;

/** By type of numbers: how many bytes each has, the array for them, and what reads one. */
const TYPES = new Map<string, [number, new (length: number) => Samples, Getter]>([
  ["|u1", [1, Uint8Array, (view, at) => view.getUint8(at)]],
  ["<u2", [2, Uint16Array, (view, at) => view.getUint16(at, true)]],
  ["<f2", [2, Float32Array, (view, at) => half(view.getUint16(at, true))]],
  ["<f4", [4, Float32Array, (view, at) => view.getFloat32(at, true)]],
  ["<f8", [8, Float64Array, (view, at) => view.getFloat64(at, true)]],
]);
type Getter = (view: DataView, at: number) => number;

/** The content of a `.npy` file, a picture. */
class Npy {
  readonly name: string;
  readonly type: string;
  readonly width: number;
  readonly height: number;
  readonly lanes: number;
  readonly numbers: Samples;

  private constructor(name: string, content: Uint8Array) {
    const [header, data] = split(name, content);
    this.name = name;
    this.type = between(name, header, "descr", "'", "'");
    const type = TYPES.get(this.type);
    if (type === undefined) {
      const known = "|u1, <u2, <f2, <f4 and <f8";
      throw new JudgeError(`${name}: has numbers of type ${this.type}; known are ${known}`);
    }
    if (!valueOf(name, header, "fortran_order").startsWith("False")) {
      throw new JudgeError(`${name}: is not in C order, row by row`);
    }
    const shape = shapeOf(name, between(name, header, "shape", "(", ")"));
    [this.height, this.width, this.lanes] = shape;
    const [size, array, get] = type;
    const count = this.height * this.width * this.lanes;
    if (data.byteLength !== count * size) {
      const found = `${data.byteLength} bytes of numbers, but needs ${count * size}`;
      throw new JudgeError(`${name}: has ${found}`);
    }
    this.numbers = new array(count);
    for (let index = 0; index < count; index++) this.numbers[index] = get(data, index * size);
  }

  static async load(path: string, read: Read): Promise<Npy> {
    let content: Bytes;
    try {
      content = await read(path);
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error);
      throw new JudgeError(`${path}: cannot be read: ${reason}`);
    }
    return Npy.parse(path, content);
  }

  static parse(name: string, content: Bytes): Npy {
    return new Npy(name, content instanceof Uint8Array ? content : new Uint8Array(content));
  }

  /** Throws a `JudgeError` for another size, or numbers of another type. */
  expect(type: string, width: number, height: number, lanes: number): void {
    if (this.width !== width || this.height !== height || this.lanes !== lanes) {
      const found = `${this.width} x ${this.height} pixels of ${this.lanes} lanes`;
      throw new JudgeError(`${this.name}: has ${found}, not ${width} x ${height} of ${lanes}`);
    }
    if (this.type !== type) {
      throw new JudgeError(`${this.name}: has numbers of type ${this.type}, not ${type}`);
    }
  }
}

/** The header and the data of a `.npy` file. */
function split(name: string, content: Uint8Array): [string, DataView] {
  const magic = [0x93, ...[..."NUMPY"].map((letter) => letter.charCodeAt(0))];
  if (content.length < 8 || magic.some((byte, index) => content[index] !== byte)) {
    throw new JudgeError(`${name}: is no .npy file`);
  }
  const [major, minor] = [content[6]!, content[7]!];
  if (major < 1 || major > 3 || minor !== 0) {
    const found = `version ${major}.${minor} of the .npy format`;
    throw new JudgeError(`${name}: has ${found}, not 1.0 to 3.0`);
  }
  const start = major === 1 ? 10 : 12;
  const length = content.subarray(8, start).reduceRight((sum, byte) => sum * 256 + byte, 0);
  const header = content.subarray(start, start + length);
  const isText = header.every((byte) => byte === 10 || (32 <= byte && byte < 127));
  if (content.length < start + length || !isText) {
    throw new JudgeError(`${name}: has a damaged header`);
  }
  const data = content.subarray(start + length);
  const text = Array.from(header, (byte) => String.fromCharCode(byte)).join("");
  return [text, new DataView(data.buffer, data.byteOffset, data.byteLength)];
}

/** The rest of a header, from the value of a key on. */
function valueOf(name: string, header: string, key: string): string {
  const at = header.indexOf(`'${key}'`);
  const rest = at < 0 ? "" : header.slice(at + key.length + 2).trimStart();
  if (!rest.startsWith(":")) throw new JudgeError(`${name}: has a damaged header: no ${key}`);
  return rest.slice(1).trimStart();
}

/** The text between the two letters that enclose the value of a key. */
function between(name: string, header: string, key: string, first: string, last: string): string {
  const value = valueOf(name, header, key);
  const end = value.indexOf(last, 1);
  if (!value.startsWith(first) || end < 0) {
    throw new JudgeError(`${name}: has a damaged header: no ${key}`);
  }
  return value.slice(1, end);
}

/** The height, the width and the lanes in a header's shape, `56, 72, 4` or `56, 72`. */
function shapeOf(name: string, text: string): [number, number, number] {
  const sides = text.trimEnd().replace(/,$/, "").split(",").map((side) => side.trim());
  const numbers = sides.map((side) => (/^\d{1,5}$/.test(side) ? Number(side) : 0));
  const [height = 0, width = 0, lanes = 1] = numbers;
  const isSide = (side: number): boolean => 1 <= side && side <= LONGEST_SIDE;
  if (isSide(height) && isSide(width) && 1 <= lanes && lanes <= 4 && numbers.length <= 3) {
    return [height, width, lanes];
  }
  const wanted = "height, width and 1 to 4 lanes";
  throw new JudgeError(`${name}: has the shape (${text}), which is no picture: ${wanted}`);
}

/** The value of a 16-bit float. */
function half(bits: number): number {
  const [exponent, fraction] = [(bits >> 10) & 0x1f, bits & 0x3ff];
  const sign = bits >> 15 ? -1 : 1;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (fraction + 1024) * 2 ** (exponent - 25);
}
