"""Functions that code of derived values calls where the library of Rust has none."""

from __future__ import annotations

from collections.abc import Mapping

FUNCTIONS: Mapping[str, str] = {
    "whole": """\
/// The number without its fraction; 0 of infinity and beyond 64 bits.
fn whole(x: f64) -> i64 {
    if x.abs() < f64::powi(2.0, 63) { x as i64 } else { 0 }
}
""",
    "remainder_of": """\
/// The remainder of a quotient that is rounded down; it has the sign of `y`.
fn remainder_of(x: i64, y: i64) -> i64 {
    let rest = x % y;
    if rest != 0 && (rest < 0) != (y < 0) { rest + y } else { rest }
}
""",
    "floored_remainder": """\
/// The remainder of a quotient that is rounded down; it has the sign of `y`.
fn floored_remainder(x: f64, y: f64) -> f64 {
    let rest = x % y;
    if rest != 0.0 && (rest < 0.0) != (y < 0.0) { rest + y } else { rest }
}
""",
    "scaled": """\
/// `x` times two to the power of `n`, in steps that are no infinity themselves.
fn scaled(x: f64, n: i64) -> f64 {
    let n = n.clamp(-2200, 2200) as i32;
    let third = n / 3;
    x * f64::powi(2.0, third) * f64::powi(2.0, third) * f64::powi(2.0, n - 2 * third)
}
""",
    "fraction_of": """\
/// The fraction of a number, at least a half and below one.
fn fraction_of(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let normal = if x.is_normal() { x } else { x * f64::powi(2.0, 64) };
    f64::from_bits(normal.to_bits() & !(0x7ff << 52) | 0x3fe << 52)
}
""",
    "exponent_of": """\
/// The exponent of a number whose fraction is at least a half and below one.
fn exponent_of(x: f64) -> i64 {
    if x == 0.0 || !x.is_finite() {
        return 0;
    }
    let biased = |x: f64| (x.to_bits() >> 52 & 0x7ff) as i64 - 1022;
    if x.is_normal() { biased(x) } else { biased(x * f64::powi(2.0, 64)) - 64 }
}
""",
}
