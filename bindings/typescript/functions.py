"""Functions that code of derived values calls where JavaScript has none."""

from __future__ import annotations

from collections.abc import Mapping

FUNCTIONS: Mapping[str, str] = {
    "nearest": """\
/** The nearest whole number, and the even one in the middle between two. */
function nearest(x: number): number {
  const found = Math.round(x);
  return Math.abs(x % 1) === 0.5 && found % 2 !== 0 ? found - 1 : found;
}
""",
    "remainder": """\
/** The remainder of a quotient that is rounded down; it has the sign of `y`. */
function remainder(x: number, y: number): number {
  const rest = x % y;
  return rest !== 0 && rest < 0 !== y < 0 ? rest + y : rest;
}
""",
    "whole": """\
/** The number without its fraction; 0 of infinity. */
function whole(x: number): number {
  return Number.isFinite(x) ? Math.trunc(x) : 0;
}
""",
    "exponentOf": """\
/** The exponent of a number whose fraction is at least a half and below one. */
function exponentOf(x: number): number {
  if (x === 0 || !Number.isFinite(x)) return 0;
  const found = Math.floor(Math.log2(Math.abs(x))) + 1;
  // Logarithms are rounded.
  const fraction = Math.abs(x) / 2 ** found;
  return fraction >= 1 ? found + 1 : fraction < 0.5 ? found - 1 : found;
}
""",
}
