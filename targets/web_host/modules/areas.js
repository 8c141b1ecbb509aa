// What a step sets for all that it draws: see `viewport`, `scissor` and `blend_constant` in
// docs/plans.md.
export const USUAL = { viewport: null, scissor: null, blendConstant: [0, 0, 0, 0] };
/** The viewport in targets of a size, and all that is drawn to: nothing is drawn outside of it. */
export function areasOf(settings, width, height) {
    const whole = [0, 0, width, height];
    const viewport = settings.viewport ?? whole;
    const [left, top, wide, high] = viewport;
    if (left < 0 || top < 0 || left + wide > width || top + high > height || Math.min(wide, high) < 1) {
        throw new Error(`the viewport of ${wide} x ${high} texels at ${left}, ${top} is not within targets of ${width} x ${height}`);
    }
    return [viewport, common(viewport, settings.scissor ?? whole)];
}
function common(one, other) {
    const [left, top] = [0, 1].map((side) => Math.max(one[side], other[side]));
    const [right, bottom] = [0, 1].map((side) => Math.min(one[side] + one[side + 2], other[side] + other[side + 2]));
    return right > left && bottom > top ? [left, top, right - left, bottom - top] : [0, 0, 0, 0];
}
