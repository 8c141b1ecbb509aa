// What a step sets for all that it draws: see `viewport`, `scissor` and `blend_constant` in
// docs/plans.md.

/** A part of a picture: left, top, width and height. */
export type Area = [number, number, number, number];

export interface DrawSettings {
  /** Into which part of the targets the clip volume is drawn; null: into all of it. */
  viewport: Area | null;
  /** To which part of the targets is drawn; null: to all of it. */
  scissor: Area | null;
  /** What the factor `constant` means where targets are blended. */
  blendConstant: number[];
}

export const USUAL: DrawSettings = { viewport: null, scissor: null, blendConstant: [0, 0, 0, 0] };

/** The viewport in targets of a size, and all that is drawn to: nothing is drawn outside of it. */
export function areasOf(settings: DrawSettings, width: number, height: number): [Area, Area] {
  const whole: Area = [0, 0, width, height];
  const viewport = settings.viewport ?? whole;
  const [left, top, wide, high] = viewport;
  if (left < 0 || top < 0 || left + wide > width || top + high > height || Math.min(wide, high) < 1) {
    throw new Error(
      `the viewport of ${wide} x ${high} texels at ${left}, ${top} is not within targets of ${width} x ${height}`,
    );
  }
  return [viewport, common(viewport, settings.scissor ?? whole)];
}

function common(one: Area, other: Area): Area {
  const [left, top] = [0, 1].map((side) => Math.max(one[side], other[side]));
  const [right, bottom] = [0, 1].map((side) => Math.min(one[side] + one[side + 2], other[side] + other[side + 2]));
  return right > left && bottom > top ? [left, top, right - left, bottom - top] : [0, 0, 0, 0];
}
