// The textures and buffers of a plan, with their sizes; some are kept for the next frame.

import { halved } from "./bytes.js";
import { present } from "./present.js";

/**
 * @import { Package, RunStep } from "./generated/documents.js"
 * @import { Bound, Renderer } from "./renderer.js"
 * @import { SizeOf, Step } from "./steps.js"
 * @import { Values } from "./values.js"
 */

/** @template Texture, Buffer */
export class Resources {
  /** The host's pictures, by their numbers in the package. @readonly @type {Texture[]} */
  pictures;
  /**
   * The buffers that kernels have written, by result, and the host's, by `hostBuffer`.
   * @readonly @type {Map<string, Buffer>}
   */
  buffers = new Map();
  /** @type {Map<number, Texture>} */
  #textures = new Map();
  /**
   * The size of the elements of each buffer that a kernel has written, in bytes.
   * @type {Map<Buffer, number>}
   */
  #lengths = new Map();
  /**
   * The number of texels, or elements, that each kernel of this frame has computed, by step.
   * @type {Map<string, number[]>}
   */
  #extents = new Map();

  #from;
  #renderer;
  #values;

  /**
   * @param {Package} from
   * @param {Renderer<Texture, Buffer>} renderer
   * @param {Values} values
   */
  constructor(from, renderer, values) {
    this.#from = from;
    this.#renderer = renderer;
    this.#values = values;
    this.pictures = from.pictures.map((picture) => renderer.makePicture(picture));
  }

  /**
   * Prepare the next frame; returns true if the results that the last frame has kept are there.
   * @param {boolean} isFirst
   * @returns {boolean}
   */
  begin(isFirst) {
    const { kept } = this.#from.plan;
    const finds = !isFirst && kept.every(({ previous: at }) => at === null || this.#fits(at));
    if (!finds) kept.forEach((row) => [row.texture, row.previous].forEach((at) => this.#free(at)));
    this.#extents.clear();
    return finds;
  }

  /** Called after the last step: the kept results become those of the last frame. */
  end() {
    for (const { result, texture, previous } of this.#from.plan.kept) {
      if (texture === null) exchange(this.buffers, result, previousOf(result));
      else exchange(this.#textures, texture, present(previous));
    }
  }

  /**
   * The texture of an output; undefined if it is no picture, or was not drawn yet.
   * @param {string} result
   * @param {number | null} texture
   * @returns {Texture | undefined}
   */
  shown(result, texture) {
    const kept = this.#from.plan.kept.find((each) => each.result === result);
    return this.#textures.get(kept?.previous ?? texture ?? -1);
  }

  /**
   * The buffer that a kernel has written; undefined if it writes none, or was not run yet.
   * @param {string} result
   * @returns {Buffer | undefined}
   */
  written(result) {
    const isKept = this.#from.plan.kept.some((each) => each.result === result);
    return this.buffers.get(isKept ? previousOf(result) : result);
  }

  /**
   * The size of the elements of a buffer in bytes; 0 if it has none.
   * @param {Buffer} buffer
   * @returns {number}
   */
  bytesIn(buffer) {
    return this.#lengths.get(buffer) ?? this.#renderer.bytesIn(buffer);
  }

  /**
   * A number, vector or matrix of the plan.
   * @param {number} value
   * @returns {number[]}
   */
  number(value) {
    const { values: rows } = this.#from.plan;
    /** @type {SizeOf} */
    const sizeOf = (name) => this.#renderer.sizeOf(this.pictures[this.#from.textures[name]]);
    return /** @type {number[]} */ (this.#values.evaluated(rows[value].steps, sizeOf));
  }

  /**
   * The width and height of a texture's first level.
   * @param {number} texture
   * @returns {number[]}
   */
  sizeOf(texture) {
    const { value, extent_of, level } = this.#from.plan.textures[texture].size;
    const sides = value !== null ? this.number(value) : this.#extents.get(present(extent_of));
    if (!sides) throw new Error(`the size of \`${extent_of}\` is needed before it is run`);
    if (!(Math.min(...sides) >= 1)) {
      const { frame } = this.#from.plan;
      throw new Error(`a texture of ${frame} would have ${sides.join(" x ")} texels`);
    }
    return sides.map((side) => halved(side, level));
  }

  /**
   * A texture of the plan, made when it is first needed, and again when its size changes.
   * @param {number} number
   * @returns {Texture}
   */
  texture(number) {
    if (this.#fits(number)) return present(this.#textures.get(number));
    this.#free(number);
    const row = this.#from.plan.textures[number];
    const [width, height] = this.sizeOf(number);
    const format = this.#from.formats[number];
    const texture = this.#renderer.makeTexture({ ...row, format, width, height });
    this.#textures.set(number, texture);
    return texture;
  }

  /**
   * The number of texels, or elements, that a kernel computes.
   * @param {RunStep} step
   * @param {Bound<Texture, Buffer>} kernel
   * @returns {number[]}
   */
  extent(step, kernel) {
    const { extent } = this.#from.shaders[step.use.shader].reflection;
    const found = this.#evaluated(present(extent), kernel);
    this.#extents.set(step.name, found);
    return found;
  }

  /**
   * @param {Step[]} steps
   * @param {Bound<Texture, Buffer>} bound
   * @returns {number[]}
   */
  #evaluated(steps, { values, textures }) {
    /** @type {SizeOf} */
    const sizeOf = (name) => this.#renderer.sizeOf(present(textures.get(name)));
    return /** @type {number[]} */ (values.evaluated(steps, sizeOf));
  }

  /**
   * Bind the buffers that a kernel writes: new ones, or those of the last frame.
   * @param {RunStep} step
   * @param {Bound<Texture, Buffer>} bound
   */
  giveWritten({ buffers, use }, bound) {
    const { results } = this.#from.shaders[use.shader].reflection;
    for (const { name, result } of buffers) {
      const { count, stride, initial } = present(results.find((each) => each.name === name));
      const [elements] = this.#evaluated(count, bound);
      const bytes = new Uint8Array(Math.max(elements, 1) * stride);
      if (initial !== null) new Int32Array(bytes.buffer).fill(initial | 0);
      const buffer = this.#buffer(result, bytes, initial !== null);
      this.#lengths.set(buffer, Math.max(elements, 0) * stride);
      bound.buffers.set(name, buffer);
    }
  }

  /**
   * @param {string} result
   * @param {Uint8Array<ArrayBuffer>} bytes
   * @param {boolean} isFilled
   * @returns {Buffer}
   */
  #buffer(result, bytes, isFilled) {
    const known = this.buffers.get(result);
    if (known && this.#renderer.bytesIn(known) === bytes.length) {
      if (isFilled) this.#renderer.fill(known, bytes);
      return known;
    }
    if (known) {
      this.#renderer.free(known);
      this.#lengths.delete(known);
    }
    const made = this.#renderer.makeBuffer(bytes);
    this.buffers.set(result, made);
    return made;
  }

  /**
   * @param {number} texture
   * @returns {boolean}
   */
  #fits(texture) {
    const made = this.#textures.get(texture);
    if (!made) return false;
    const sides = this.#renderer.sizeOf(made);
    return this.sizeOf(texture).every((side, axis) => side === sides[axis]);
  }

  /** @param {number | null} texture */
  #free(texture) {
    const made = this.#textures.get(texture ?? -1);
    if (made) this.#renderer.free(made);
    this.#textures.delete(texture ?? -1);
  }
}

/** The name of a buffer that the last frame has kept. @type {(result: string) => string} */
export const previousOf = (result) => `previous(${result})`;
/**
 * The name of a buffer of the host, distinct from those of results.
 * @type {(owner: string, name: string) => string}
 */
export const hostBuffer = (owner, name) => `${name} of ${owner}, set by the host`;

/**
 * @template Key, Item
 * @param {Map<Key, Item>} items
 * @param {Key} one
 * @param {Key} other
 */
function exchange(items, one, other) {
  const [first, second] = [items.get(one), items.get(other)];
  items.delete(one);
  if (second !== undefined) items.set(one, second);
  if (first !== undefined) items.set(other, first);
}
