// Bytes that packages hold in base64, and texels that come back from a device.

/** The bytes of a text in base64. */
export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let at = 0; at < text.length; at++) bytes[at] = text.charCodeAt(at);
  return bytes;
}

export const isDepth = (format: GPUTextureFormat) => format.startsWith("depth");
export const hasStencil = (format: GPUTextureFormat) => format.endsWith("stencil8");

/** A side of a mip level. */
export const halved = (side: number, level: number) => Math.max(side >> level, 1);

/** How many lanes a texel has, and how many bytes each of them. */
export function lanesOf(format: GPUTextureFormat): [number, number] {
  const count = /^rgba/.test(format) ? 4 : /^rg/.test(format) ? 2 : 1;
  return [count, Number(/\d+/.exec(format)![0]) / 8];
}

/** Tightly packed texels as a shader reads them: four numbers each. */
export function toFloats(format: GPUTextureFormat, bytes: Uint8Array<ArrayBuffer>): Float32Array {
  const [count, size] = lanesOf(format);
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const decoders: Record<number, (at: number) => number> = {
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

function floatOfHalf(bits: number): number {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 0x3ff;
  const sign = bits & 0x8000 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (fraction + 1024) * 2 ** (exponent - 25) : fraction * 2 ** -24);
}

const linear = (x: number) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
