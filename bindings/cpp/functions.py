"""Functions that code of derived values calls where the library of C++ has none."""

from __future__ import annotations

from collections.abc import Mapping

FUNCTIONS: Mapping[str, str] = {
    "whole": """\
/// The number without its fraction; 0 of infinity and beyond 64 bits.
inline std::int64_t whole(double x) {
    return std::abs(x) < 0x1p+63 ? static_cast<std::int64_t>(x) : 0;
}
""",
    "remainder_of": """\
/// The remainder of a quotient that is rounded down; it has the sign of `y`.
inline std::int64_t remainder_of(std::int64_t x, std::int64_t y) {
    const std::int64_t rest = x % y;
    return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
}
""",
    "floored_remainder": """\
/// The remainder of a quotient that is rounded down; it has the sign of `y`.
inline double floored_remainder(double x, double y) {
    const double rest = std::fmod(x, y);
    return rest != 0.0 && (rest < 0.0) != (y < 0.0) ? rest + y : rest;
}
""",
    "wide_product": """\
/// A product of which only the lowest 32 bits matter.
inline std::int64_t wide_product(std::int64_t x, std::int64_t y) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(x) * static_cast<std::uint64_t>(y));
}
""",
    "wrapped": """\
/// The lowest 32 bits, as a number with a sign.
inline std::int64_t wrapped(std::int64_t x) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x));
}
""",
    "fraction_of": """\
/// The fraction of a number, at least a half and below one.
inline double fraction_of(double x) {
    int exponent = 0;
    return std::frexp(x, &exponent);
}
""",
    "exponent_of": """\
/// The exponent of a number whose fraction is at least a half and below one.
inline std::int64_t exponent_of(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return exponent;
}
""",
}
