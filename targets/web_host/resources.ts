// The textures and buffers of a plan: which size they have, and what is kept for the next frame.

import { halved } from "./bytes.js";
import type { Package, RunStep } from "./generated/documents.js";
import type { Bound, Renderer } from "./renderer.js";
import type { Step } from "./steps.js";
import type { Values } from "./values.js";

export class Resources<Texture, Buffer> {
  /** The host's pictures, by their numbers in the package. */
  readonly pictures: Texture[];
  /** By the results that kernels have written, and the host's by the names of `hostBuffer`. */
  readonly buffers = new Map<string, Buffer>();
  private readonly textures = new Map<number, Texture>();
  /** How many bytes of a buffer its elements are: of those that kernels have written. */
  private readonly lengths = new Map<Buffer, number>();
  /** How many texels, or elements, the kernels compute that this frame has run, by step. */
  private readonly extents = new Map<string, number[]>();

  constructor(
    private readonly from: Package,
    private readonly renderer: Renderer<Texture, Buffer>,
    private readonly values: Values,
  ) {
    this.pictures = from.pictures.map((picture) => renderer.makePicture(picture));
  }

  /** Get ready for the next frame; returns whether it finds what the last one has kept. */
  begin(isFirst: boolean): boolean {
    const { kept } = this.from.plan;
    const finds = !isFirst && kept.every(({ previous: at }) => at === null || this.fits(at));
    if (!finds) kept.forEach((row) => [row.texture, row.previous].forEach((at) => this.free(at)));
    this.extents.clear();
    return finds;
  }

  /** Behind the last step: what was drawn is then what the next frame finds. */
  end(): void {
    for (const { result, texture, previous } of this.from.plan.kept) {
      if (texture === null) exchange(this.buffers, result, previousOf(result));
      else exchange(this.textures, texture, previous!);
    }
  }

  /** What an output shows, or undefined if it is no picture, or was not drawn yet. */
  shown(result: string, texture: number | null): Texture | undefined {
    const kept = this.from.plan.kept.find((each) => each.result === result);
    return this.textures.get(kept?.previous ?? texture ?? -1);
  }

  /** The buffer that a kernel has written, or undefined if it is none, or was not run yet. */
  written(result: string): Buffer | undefined {
    const isKept = this.from.plan.kept.some((each) => each.result === result);
    return this.buffers.get(isKept ? previousOf(result) : result);
  }

  /** How many bytes the elements of a buffer have; there may be none. */
  bytesIn(buffer: Buffer): number {
    return this.lengths.get(buffer) ?? this.renderer.bytesIn(buffer);
  }

  /** A number, vector or matrix of the plan. */
  number(value: number): number[] {
    const { values: rows } = this.from.plan;
    const sizeOf = (name: string) => this.renderer.sizeOf(this.pictures[this.from.textures[name]]);
    return this.values.evaluated(rows[value].steps, sizeOf) as number[];
  }

  /** The width and height of a texture's first level. */
  sizeOf(texture: number): number[] {
    const { value, extent_of, level } = this.from.plan.textures[texture].size;
    const sides = value !== null ? this.number(value) : this.extents.get(extent_of!);
    if (!sides) throw new Error(`the size of \`${extent_of}\` is needed before it is run`);
    if (!(Math.min(...sides) >= 1)) {
      const { frame } = this.from.plan;
      throw new Error(`a texture of ${frame} would have ${sides.join(" x ")} texels`);
    }
    return sides.map((side) => halved(side, level));
  }

  /** A texture of the plan, which is made when it is needed first, and anew for another size. */
  texture(number: number): Texture {
    if (this.fits(number)) return this.textures.get(number)!;
    this.free(number);
    const row = this.from.plan.textures[number];
    const [width, height] = this.sizeOf(number);
    const format = this.from.formats[number];
    const texture = this.renderer.makeTexture({ ...row, format, width, height });
    this.textures.set(number, texture);
    return texture;
  }

  /** How many texels, or elements, a kernel computes that is run. */
  extent(step: RunStep, kernel: Bound<Texture, Buffer>): number[] {
    const { extent } = this.from.shaders[step.use.shader].reflection;
    const found = this.evaluated(extent!, kernel);
    this.extents.set(step.name, found);
    return found;
  }

  private evaluated(steps: Step[], { values, textures }: Bound<Texture, Buffer>): number[] {
    return values.evaluated(steps, (name) => this.renderer.sizeOf(textures.get(name)!)) as number[];
  }

  /** Give a kernel the buffers that it writes, new ones or those of the last frame. */
  giveWritten({ buffers, use }: RunStep, bound: Bound<Texture, Buffer>): void {
    const { results } = this.from.shaders[use.shader].reflection;
    for (const { name, result } of buffers) {
      const { count, stride, initial } = results.find((each) => each.name === name)!;
      const [elements] = this.evaluated(count, bound);
      const bytes = new Uint8Array(Math.max(elements, 1) * stride);
      if (initial !== null) new Int32Array(bytes.buffer).fill(initial | 0);
      const buffer = this.buffer(result, bytes, initial !== null);
      this.lengths.set(buffer, Math.max(elements, 0) * stride);
      bound.buffers.set(name, buffer);
    }
  }

  private buffer(result: string, bytes: Uint8Array<ArrayBuffer>, isFilled: boolean): Buffer {
    const known = this.buffers.get(result);
    if (known && this.renderer.bytesIn(known) === bytes.length) {
      if (isFilled) this.renderer.fill(known, bytes);
      return known;
    }
    if (known) {
      this.renderer.free(known);
      this.lengths.delete(known);
    }
    const made = this.renderer.makeBuffer(bytes);
    this.buffers.set(result, made);
    return made;
  }

  private fits(texture: number): boolean {
    const made = this.textures.get(texture);
    if (!made) return false;
    const sides = this.renderer.sizeOf(made);
    return this.sizeOf(texture).every((side, axis) => side === sides[axis]);
  }

  private free(texture: number | null): void {
    const made = this.textures.get(texture ?? -1);
    if (made) this.renderer.free(made);
    this.textures.delete(texture ?? -1);
  }
}

/** What a buffer is called that the last frame has left. */
export const previousOf = (result: string) => `previous(${result})`;
/** What a buffer of the host is called, which may have the name of a shader's. */
export const hostBuffer = (owner: string, name: string) => `${name} of ${owner}, set by the host`;

function exchange<Key, Item>(items: Map<Key, Item>, one: Key, other: Key): void {
  const [first, second] = [items.get(one), items.get(other)];
  items.delete(one);
  if (second !== undefined) items.set(one, second);
  if (first !== undefined) items.set(other, first);
}
