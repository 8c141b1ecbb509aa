// The settings of a step for all its draw calls: see `viewport`, `scissor` and `blend_constant`
// in docs/plans.md.

/** @import { Area, DrawSettings } from "./renderer.js" */

/**
 * The settings of a step whose targets have this size; each argument may be null, for its default.
 * @param {number[]} size
 * @param {number[] | null} [viewport]
 * @param {number[] | null} [scissor]
 * @param {number[] | null} [constant]
 * @returns {DrawSettings}
 */
export function settingsOf([width, height], viewport, scissor, constant) {
  /** @type {Area} */
  const whole = [0, 0, width, height];
  const seen = /** @type {Area} */ (viewport ?? whole);
  const [left, top, wide, high] = seen;
  if (Math.min(wide, high) < 1 || common(seen, whole).some((side, at) => side !== seen[at])) {
    const wrong = `the viewport of ${wide} x ${high} texels at ${left}, ${top}`;
    throw new Error(`${wrong} is not within targets of ${width} x ${height}`);
  }
  return {
    viewport: seen,
    scissor: common(seen, /** @type {Area} */ (scissor ?? whole)),
    blendConstant: /** @type {DrawSettings["blendConstant"]} */ (constant ?? [0, 0, 0, 0]),
  };
}

/**
 * @param {Area} one
 * @param {Area} other
 * @returns {Area}
 */
function common(one, other) {
  /** @type {(area: Area, side: number) => number} */
  const end = (area, side) => area[side] + area[side + 2];
  const [left, top] = [0, 1].map((side) => Math.max(one[side], other[side]));
  const [right, bottom] = [0, 1].map((side) => Math.min(end(one, side), end(other, side)));
  return right > left && bottom > top ? [left, top, right - left, bottom - top] : [0, 0, 0, 0];
}
