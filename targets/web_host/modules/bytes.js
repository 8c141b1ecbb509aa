// Bytes that packages hold in base64, and texels that come back from a device.
import { halfOfBits } from "./functions.js";
/** The bytes of a text in base64. */
export function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let at = 0; at < text.length; at++)
        bytes[at] = text.charCodeAt(at);
    return bytes;
}
export const wordsOf = (base64) => new Uint32Array(bytesOf(base64).buffer);
/** The format of a texture for each format of the language. All APIs can draw to these; lanes of
 * ten bits are drawn with eight, which are clamped and blended in the same way. */
const FORMATS = {
    r8: "r8unorm", rg8: "rg8unorm", rgba8: "rgba8unorm", rgba8_srgb: "rgba8unorm-srgb",
    bgra8: "rgba8unorm", bgra8_srgb: "rgba8unorm-srgb", rgb10a2: "rgba8unorm",
    r16f: "r16float", rg16f: "rg16float", rgba16f: "rgba16float",
    r32f: "r32float", rg32f: "rg32float", rgba32f: "rgba32float",
    depth32f: "depth32float", depth32f_stencil8: "depth32float-stencil8",
};
export function formatOf(name) {
    if (!(name in FORMATS))
        throw new Error(`this host does not know the format ${name}`);
    return FORMATS[name];
}
export const isDepth = (format) => format.startsWith("depth");
export const hasStencil = (format) => format.endsWith("stencil8");
/** How many lanes a texel has, and how many bytes each of them. */
export function lanesOf(format) {
    const count = /^rgba/.test(format) ? 4 : /^rg/.test(format) ? 2 : 1;
    return [count, Number(/\d+/.exec(format)[0]) / 8];
}
/** Tightly packed texels as a shader reads them: four numbers each. */
export function toFloats(format, bytes) {
    const [count, size] = lanesOf(format);
    const lanes = size === 4
        ? new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4)
        : size === 2
            ? new Uint16Array(bytes.buffer, bytes.byteOffset, bytes.length / 2)
            : bytes;
    const decode = size === 4 ? (x) => x : size === 2 ? floatOfHalf : (x) => x / 255;
    const found = new Float32Array((lanes.length / count) * 4);
    for (let at = 0; at < found.length; at++) {
        const lane = at % 4;
        const value = lane < count ? decode(lanes[(at >> 2) * count + lane]) : lane === 3 ? 1 : 0;
        found[at] = format.endsWith("srgb") && lane < 3 ? linear(value) : value;
    }
    return found;
}
/** Sixteen bits as a number, those included that are none or infinite. */
function floatOfHalf(bits) {
    if (((bits >> 10) & 31) !== 31)
        return halfOfBits(bits);
    return bits & 0x3ff ? NaN : bits & 0x8000 ? -Infinity : Infinity;
}
const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
