// Colours as people pick them, `#rrggbb` in sRGB, and as shaders take them, in linear light.

/**
 * The factor by which a colour is brighter than one that a picker has; 1 within a picker's range.
 * @param {readonly number[]} color
 * @returns {number}
 */
export function strengthOf(color) {
  return Math.max(1, ...color.slice(0, 3));
}

/**
 * @param {readonly number[]} color
 * @param {number} strength
 * @returns {string}
 */
export function toHex(color, strength) {
  const lanes = color.slice(0, 3).map((lane) => Math.round(255 * encoded(lane / strength)));
  return `#${lanes.map((lane) => lane.toString(16).padStart(2, "0")).join("")}`;
}

/**
 * @param {string} hex
 * @param {number} strength
 * @returns {number[]}
 */
export function fromHex(hex, strength) {
  return [1, 3, 5].map((at) => strength * decoded(parseInt(hex.slice(at, at + 2), 16) / 255));
}

/**
 * @param {number} linear
 * @returns {number}
 */
function encoded(linear) {
  const lane = Math.min(Math.max(linear, 0), 1);
  return lane <= 0.0031308 ? 12.92 * lane : 1.055 * lane ** (1 / 2.4) - 0.055;
}

/**
 * @param {number} lane
 * @returns {number}
 */
function decoded(lane) {
  return lane <= 0.04045 ? lane / 12.92 : ((lane + 0.055) / 1.055) ** 2.4;
}
