// Bytes that packages hold in base64, and texels that come back from a device.

import { present } from "./present.js";

/** @import { Pixels } from "./renderer.js" */

/**
 * The bytes of a text in base64.
 * @param {string} base64
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let at = 0; at < text.length; at++) bytes[at] = text.charCodeAt(at);
  return bytes;
}

/** @type {(format: GPUTextureFormat) => boolean} */
export const isDepth = (format) => format.startsWith("depth");
/** @type {(format: GPUTextureFormat) => boolean} */
export const hasStencil = (format) => format.endsWith("stencil8");

/** A side of a mip level. @type {(side: number, level: number) => number} */
export const halved = (side, level) => Math.max(side >> level, 1);

/**
 * The number of lanes of a texel, and of bytes of each lane.
 * @param {GPUTextureFormat} format
 * @returns {[number, number]}
 */
export function lanesOf(format) {
  const count = /^rgba/.test(format) ? 4 : /^rg/.test(format) ? 2 : 1;
  return [count, Number(present(/\d+/.exec(format))[0]) / 8];
}

/**
 * Tightly packed texels as a shader reads them: four numbers each.
 * @param {GPUTextureFormat} format
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {Float32Array}
 */
export function toFloats(format, bytes) {
  const [count, size] = lanesOf(format);
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  /** @type {Record<number, (at: number) => number>} */
  const decoders = {
    1: (at) => bytes[at] / 255,
    2: (at) => floatOfHalf(view.getUint16(2 * at, true)),
    4: (at) => view.getFloat32(4 * at, true),
  };
  const found = new Float32Array((bytes.length / size / count) * 4);
  for (let at = 0; at < found.length; at++) {
    const lane = at % 4;
    const value = lane < count ? decoders[size]((at >> 2) * count + lane) : Number(lane === 3);
    found[at] = format.endsWith("srgb") && lane < 3 ? linear(value) : value;
  }
  return found;
}

/**
 * Turns the rows of all layers over: the first one becomes the last.
 * @param {Pixels} pixels
 */
export function turnedOver({ width, height, layers, texels }) {
  const lanes = 4 * width;
  for (let layer = 0; layer < layers; layer++) {
    for (let row = 0; row < height >> 1; row++) {
      const upper = (layer * height + row) * lanes;
      const lower = (layer * height + height - 1 - row) * lanes;
      const kept = texels.slice(upper, upper + lanes);
      texels.copyWithin(upper, lower, lower + lanes);
      texels.set(kept, lower);
    }
  }
}

/**
 * @param {number} bits
 * @returns {number}
 */
function floatOfHalf(bits) {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 0x3ff;
  const sign = bits & 0x8000 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (fraction + 1024) * 2 ** (exponent - 25) : fraction * 2 ** -24);
}

/** @type {(x: number) => number} */
const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
