"""Rows for packing several small numbers into the 32 bits of a ``uint``, the first one lowest."""

from __future__ import annotations

from .accuracy import EXACT, INHERITED, Accuracy
from .facts import Fact
from .row import Builtin, nowhere

_LARGEST_HALF = 65504.0


def _quantized(facts: tuple[Fact, ...], _same: bool) -> Fact:
    """The range after quantisation.

    Rounding never decreases, and changes a value by at most half a step: 2^-11 of it, or 2^-25.
    """
    (x,) = facts
    lo, hi = (min(max(bound, -_LARGEST_HALF), _LARGEST_HALF) for bound in (x.lo, x.hi))
    lowest = 0.0 if lo >= 0 else lo - (-lo * 2.0**-11 + 2.0**-25)
    highest = 0.0 if hi <= 0 else hi + (hi * 2.0**-11 + 2.0**-25)
    return Fact(max(lowest, -_LARGEST_HALF), min(highest, _LARGEST_HALF))


def _pack(name: str, vector: str, doc: str, outside: str) -> Builtin:
    return Builtin(
        name=name,
        signatures=(f"{vector} -> uint",),
        doc=doc,
        domain=nowhere,
        outside=outside,
        expansion=name,
        cost=12,
        samples=((0.0,), (1.0,), (-1.0,), (2.0,), (0.5,)),
    )


def _unpack(name: str, vector: str, doc: str, accuracy: Accuracy = INHERITED) -> Builtin:
    return Builtin(
        name=name,
        signatures=(f"uint -> {vector}",),
        doc=doc,
        domain=nowhere,
        outside="Every bit pattern has a value.",
        expansion=name,
        accuracy=accuracy,
        cost=8,
        samples=((0,), (0xFFFFFFFF,), (0x80FF7F01,)),
    )


_TO_255 = "Lanes are clamped to 0 to 1."
_TO_127 = "Lanes are clamped to -1 to 1."

ROWS = (
    _pack("pack_unorm4x8", "vec4", "Four lanes as bytes: round(x * 255).", _TO_255),
    _pack("pack_snorm4x8", "vec4", "Four lanes as signed bytes: round(x * 127).", _TO_127),
    _pack("pack_unorm2x16", "vec2", "Two lanes in 16 bits each: round(x * 65535).", _TO_255),
    _pack("pack_snorm2x16", "vec2", "Two lanes in 16 signed bits each: round(x * 32767).", _TO_127),
    _pack(
        "pack_half2x16",
        "vec2",
        "Two lanes as floats of 16 bits (IEEE 754 binary16), rounded to the nearest, ties to even.",
        "Lanes are clamped to -65504 to 65504, the largest such floats; zeros have no sign.",
    ),
    _unpack("unpack_unorm4x8", "vec4", "Four bytes as lanes: byte / 255."),
    _unpack("unpack_snorm4x8", "vec4", "Four signed bytes as lanes: max(byte / 127, -1)."),
    _unpack("unpack_unorm2x16", "vec2", "Two times 16 bits as lanes: bits / 65535."),
    _unpack(
        "unpack_snorm2x16",
        "vec2",
        "Two times 16 signed bits as lanes: max(bits / 32767, -1).",
    ),
    _unpack(
        "unpack_half2x16",
        "vec2",
        "Two floats of 16 bits as lanes; infinities and NaN become 0.",
        EXACT,
    ),
    Builtin(
        name="quantize_half",
        signatures=("T -> T",),
        doc="The value after `pack_half2x16` and `unpack_half2x16`: rounded to 16 bits.",
        domain=nowhere,
        outside="Clamped to -65504 to 65504.",
        expansion="quantize_half",
        range=_quantized,
        accuracy=EXACT,
        cost=12,
        samples=((0.1,), (1e-6,), (70000.0,), (2049.0,), (1e-9,)),
    ),
)
