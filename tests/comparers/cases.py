"""Pictures and golden folders, whole and damaged, with what every comparer has to say of them.

The numbers are worked out by hand. Unless a case says otherwise, a picture has two rows of three
pixels with three lanes, all of which may lie in 0.25 .. 0.75.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .folders import Array, Case, npy, raw

SHAPE = (2, 3, 3)
NAN, INF = float("nan"), float("inf")
GOOD = "good: 6 pixels compared, 0 undecided, 0 outside of the bounds"
ONE_BAD = "bad: 6 pixels compared, 0 undecided, 1 outside of the bounds; the worst, at "
NO_PICTURE = "which is no picture: height, width and 1 to 4 lanes"
KNOWN = "known are |u1, <u2, <f2, <f4 and <f8"

At = Mapping[Any, float]
"""Numbers by row, column and lane."""
Options = dict[str, Any]
"""Arguments of ``case``."""


def filled(value: float, type_: str = "f8", at: At | None = None, shape: Any = SHAPE) -> Array:
    """An array that has a value everywhere but at some places."""
    array = np.full(shape, value, type_)
    for place, other in (at or {}).items():
        array[place] = other
    return array


def case(
    name: str,
    expected: str,
    picture: Array | bytes | None = None,
    *,
    lower: Array | bytes | None = None,
    upper: Array | bytes | None = None,
    undecided: Array | bytes | None = None,
    missing: str = "",
    **options: Any,
) -> Case:
    """A case in which all that is not told is good."""
    told = {
        "lower.npy": filled(0.25) if lower is None else lower,
        "upper.npy": filled(0.75) if upper is None else upper,
        "undecided.npy": filled(0, "u1", shape=(2, 3)) if undecided is None else undecided,
        "picture.npy": filled(0.5) if picture is None else picture,
    }
    files = {
        each: content if isinstance(content, bytes) else npy(content)
        for each, content in told.items()
        if each != missing
    }
    return Case(name, expected, files, **options)


def floats() -> Iterator[Case]:
    for type_ in ("f2", "f4", "f8"):
        yield case(f"{type_} inside", GOOD, filled(0.5, type_))
        ends = {(0, 0, 0): 0.25, (1, 2, 2): 0.75}
        yield case(f"{type_} at the ends", GOOD, filled(0.5, type_, ends))
        yield case(
            f"{type_} outside",
            f"{ONE_BAD}x 2, y 1, lane 1, is 0.765625, not within 0.25 .. 0.75",
            filled(0.5, type_, {(1, 2, 1): 0.765625}),
        )
    above = {(0, 1, 2): 0.75 + 2**-54}
    yield case(
        "a last bit",
        f"{ONE_BAD}x 1, y 0, lane 2, is 0.7500000000000001, not within 0.25 .. 0.75",
        filled(0.5, at={(0, 1, 2): 0.75 + 2**-53}),
    )
    yield case("less than a last bit", GOOD, filled(0.5, at=above))
    tenth: Options = {"lower": filled(0.1), "upper": filled(0.1)}
    yield case("a tenth", GOOD, filled(0.1), **tenth)
    yield case(
        "a tenth in 32 bits",
        "bad: 6 pixels compared, 0 undecided, 6 outside of the bounds; the worst, at "
        "x 0, y 0, lane 0, is 0.10000000149011612, not within 0.1 .. 0.1",
        filled(0.1, "f4"),
        **tenth,
    )


def odd_numbers() -> Iterator[Case]:
    nan = {(1, 0, 1): NAN, (0, 0, 0): 1e300}
    yield case(
        "NaN is farthest",
        "bad: 6 pixels compared, 0 undecided, 2 outside of the bounds; the worst, at "
        "x 0, y 1, lane 1, is NaN, not within 0.25 .. 0.75",
        filled(0.5, at=nan),
    )
    for type_ in ("f2", "f4"):
        yield case(
            f"NaN in {type_}",
            f"{ONE_BAD}x 1, y 1, lane 0, is NaN, not within 0.25 .. 0.75",
            filled(0.5, type_, {(1, 1, 0): NAN}),
        )
        yield case(
            f"infinity in {type_}",
            f"{ONE_BAD}x 1, y 1, lane 0, is -inf, not within 0.25 .. 0.75",
            filled(0.5, type_, {(1, 1, 0): -INF}),
        )
    yield case(
        "infinity is as far as NaN",
        "bad: 6 pixels compared, 0 undecided, 2 outside of the bounds; the worst, at "
        "x 2, y 0, lane 2, is inf, not within 0.25 .. 0.75",
        filled(0.5, at={(0, 2, 2): INF, (1, 0, 0): NAN}),
    )
    unknown: Options = {"lower": filled(-INF), "upper": filled(INF)}
    yield case(
        "nothing known", GOOD, filled(1e300, at={(0, 0, 0): -INF, (0, 0, 1): INF}), **unknown
    )
    yield case(
        "NaN where nothing is known",
        f"{ONE_BAD}x 0, y 0, lane 0, is NaN, not within -inf .. inf",
        filled(0.5, at={(0, 0, 0): NAN}),
        **unknown,
    )
    yield case("codes where nothing is known", GOOD, filled(255, "u1"), **unknown)
    yield case("infinite bounds", GOOD, filled(INF), lower=filled(INF), upper=filled(INF))
    yield case(
        "below infinite bounds",
        "bad: 6 pixels compared, 0 undecided, 6 outside of the bounds; the worst, at "
        "x 0, y 0, lane 0, is 12345678.5, not within inf .. inf",
        filled(12345678.5),
        lower=filled(INF),
        upper=filled(INF),
    )


def small_and_large() -> Iterator[Case]:
    zero: Options = {"lower": filled(0.0), "upper": filled(0.0)}
    yield case("negative zero", GOOD, filled(-0.0), **zero)
    yield case(
        "zero within negative zeros", GOOD, filled(0.0), lower=filled(-0.0), upper=filled(-0.0)
    )
    yield case(
        "code 0 within negative zeros",
        GOOD,
        filled(0, "u1"),
        lower=filled(-0.0),
        upper=filled(-0.0),
    )
    yield case(
        "negative zero is shown as zero",
        f"{ONE_BAD}x 0, y 0, lane 0, is 0, not within 0.25 .. 0.75",
        filled(0.5, at={(0, 0, 0): -0.0}),
    )
    for type_, smallest, shown in (
        ("f2", 2.0**-24, "5.960464477539063e-8"),
        ("f4", 2.0**-149, "1.401298464324817e-45"),
        ("f8", 2.0**-1074, "5e-324"),
    ):
        yield case(
            f"the smallest number of {type_}",
            f"{ONE_BAD}x 0, y 1, lane 0, is {shown}, not within 0 .. 0",
            filled(0, type_, {(1, 0, 0): smallest}),
            **zero,
        )
        exact: Options = {"lower": filled(smallest), "upper": filled(smallest)}
        yield case(
            f"exactly the smallest number of {type_}", GOOD, filled(smallest, type_), **exact
        )
    yield case(
        "of two decimals that are equally near, the even one is shown",
        f"{ONE_BAD}x 0, y 0, lane 0, is 18.090896606445312, not within 0.25 .. 0.75",
        filled(0.5, "f4", {(0, 0, 0): 18.0908966064453125}),
    )
    for value, shown in (
        (1e16, "1e16"),
        (123456789012345.6, "123456789012345.6"),
        (-1e-5, "-1e-5"),
        (1e-4, "0.0001"),
        (-1.5e300, "-1.5e300"),
        (1000000, "1000000"),
    ):
        yield case(
            f"{shown} is shown",
            f"{ONE_BAD}x 0, y 0, lane 0, is {shown}, not within 0.25 .. 0.75",
            filled(0.5, at={(0, 0, 0): value}),
        )


def codes() -> Iterator[Case]:
    for type_, low, high in (("u1", 63, 192), ("u2", 16383, 49152)):
        ends = {(0, 0, 0): low, (1, 1, 1): high}
        yield case(f"{type_} at the ends", GOOD, filled(100 * low // 63, type_, ends))
        yield case(
            f"{type_} below",
            f"{ONE_BAD}x 0, y 0, lane 0, is {low - 1}, not within {low} .. {high}",
            filled(low, type_, {(0, 0, 0): low - 1}),
        )
        yield case(
            f"{type_} above",
            f"{ONE_BAD}x 2, y 1, lane 2, is {high + 1}, not within {low} .. {high}",
            filled(high, type_, {(1, 2, 2): high + 1}),
        )
    beyond: Options = {"lower": filled(-3.0), "upper": filled(0.0, at={(0, 0, 0): 7.0})}
    yield case("bounds beyond codes", GOOD, filled(0, "u1", {(0, 0, 0): 255}), **beyond)
    yield case(
        "bounds above all codes",
        f"{ONE_BAD}x 1, y 0, lane 1, is 254, not within 255 .. 255",
        filled(255, "u1", {(0, 1, 1): 254}),
        lower=filled(2.0),
        upper=filled(3.0),
    )


def srgb() -> Iterator[Case]:
    """In sRGB, 0.25 .. 0.75 is 0.53710 .. 0.88083: of 255, 136.96 .. 224.61."""
    shape = (2, 3, 4)
    wide: Options = {
        "lower": filled(0.25, shape=shape),
        "upper": filled(0.75, shape=shape),
        "encoding": "srgb",
    }
    for type_, low, high, alpha in (("u1", 136, 225, 63), ("u2", 35198, 57725, 16383)):
        good = filled(high, type_, {(0, 0, 0): low, (1, 1, 2): low}, shape)
        good[..., 3] = alpha
        yield case(f"{type_} in sRGB", GOOD, good, **wide)
        dark = good.copy()
        dark[1, 1, 2] = low - 1
        yield case(
            f"{type_} too dark in sRGB",
            f"{ONE_BAD}x 1, y 1, lane 2, is {low - 1}, not within {low} .. {high}",
            dark,
            **wide,
        )
        bright = good.copy()
        bright[0, 2, 1] = high + 1
        yield case(
            f"{type_} too bright in sRGB",
            f"{ONE_BAD}x 2, y 0, lane 1, is {high + 1}, not within {low} .. {high}",
            bright,
            **wide,
        )
    yield case(
        "floats have no encoding",
        "error: the picture has floats, which are linear: only integers are encoded",
        filled(0.75, shape=shape),
        **wide,
    )
    for type_, white in (("u1", 255), ("u2", 65535)):
        yield case(
            f"{type_} that is nearly white",
            f"{ONE_BAD}x 1, y 0, lane 1, is {white - 1}, not within {white} .. {white}",
            filled(white, type_, {(0, 1, 1): white - 1}),
            lower=filled(1.0),
            upper=filled(1.0),
            encoding="srgb",
        )
    yield case(
        "near black",
        f"{ONE_BAD}x 0, y 0, lane 0, is 9, not within 7 .. 8",
        filled(7, "u1", {(0, 0, 0): 9}),
        lower=filled(0.00225),
        upper=filled(0.00225),
        encoding="srgb",
    )


def shapes() -> Iterator[Case]:
    yield case("one lane", GOOD, filled(0.5, shape=(2, 3, 1)))
    yield case("no axis of lanes", GOOD, filled(0.5, shape=(2, 3)))
    yield case(
        "outside with one lane",
        f"{ONE_BAD}x 1, y 1, lane 0, is 0.8, not within 0.25 .. 0.75",
        filled(0.5, at={(1, 1): 0.8}, shape=(2, 3)),
    )
    only_last = filled(0.25, at={(1, 1, 2): 0.7})
    yield case("lanes that are not compared", GOOD, filled(0.5, shape=(2, 3, 2)), lower=only_last)
    yield case(
        "more lanes",
        "error: the picture has 4 lanes, but the bounds have 3",
        filled(0.5, shape=(2, 3, 4)),
    )
    for size in ((3, 2), (2, 2), (4, 3)):
        yield case(
            f"{size[0]} rows of {size[1]}",
            f"error: the picture has {size[1]} x {size[0]} pixels, but the bounds have 3 x 2",
            filled(0.5, shape=(*size, 3)),
        )
    yield case("no lanes", "error: the picture has 0 lanes, but the bounds have 3", lanes=0)
    yield case("five lanes", "error: the picture has 5 lanes, but the bounds have 3", lanes=5)
    numbers = "error: the picture has 18 numbers, but its size needs 12"
    yield case("fewer lanes than numbers", numbers, lanes=2)


def undecided() -> Iterator[Case]:
    corner = filled(0, "u1", {(1, 2): 1}, (2, 3))
    counts = "5 pixels compared, 1 undecided, "
    yield case(
        "an undecided pixel",
        f"good: {counts}0 outside of the bounds",
        filled(0.5, at={(1, 2, 0): 9, (1, 2, 1): NAN}),
        undecided=corner,
    )
    yield case(
        "undecided and outside",
        f"bad: {counts}1 outside of the bounds; the worst, at x 1, y 1, lane 0, "
        "is 0.875, not within 0.25 .. 0.75",
        filled(0.5, at={(1, 1, 0): 0.875, (1, 2, 0): 9}),
        undecided=corner,
    )
    nothing = "error: nothing is compared: every pixel is undecided"
    yield case("nothing compared", nothing, undecided=filled(1, "u1", shape=(2, 3)))


def ties() -> Iterator[Case]:
    two = "bad: 6 pixels compared, 0 undecided, 2 outside of the bounds; the worst, at "
    below_and_above = filled(0.5, at={(0, 1, 2): 0.125, (1, 0, 0): 0.875})
    yield case(
        "the first of equally far pixels",
        f"{two}x 1, y 0, lane 2, is 0.125, not within 0.25 .. 0.75",
        below_and_above,
    )
    yield case(
        "the first of equally far lanes",
        f"{ONE_BAD}x 1, y 1, lane 1, is 0.875, not within 0.25 .. 0.75",
        filled(0.5, at={(1, 1, 1): 0.875, (1, 1, 2): 0.125}),
    )
    yield case(
        "the first of equally far codes",
        f"{two}x 0, y 0, lane 1, is 60, not within 63 .. 192",
        filled(100, "u1", {(0, 0, 1): 60, (1, 0, 0): 195}),
    )
    yield case(
        "the farther one later",
        f"{two}x 0, y 1, lane 2, is 0.1, not within 0.25 .. 0.75",
        filled(0.5, at={(0, 0, 0): 0.8, (1, 0, 0): 0.125, (1, 0, 2): 0.1}),
    )


def damaged_bounds() -> Iterator[Case]:
    at = "is damaged at x 1, y 0, lane 2: lower is"
    yield case(
        "lower above upper",
        f"error: lower.npy: {at} 0.875, upper 0.75",
        lower=filled(0.25, at={(0, 1, 2): 0.875}),
    )
    for end, expected in (("lower", f"{at} NaN, upper 0.75"), ("upper", f"{at} 0.25, upper NaN")):
        value = {"lower": 0.25, "upper": 0.75}[end]
        damaged: Options = {end: filled(value, at={(0, 1, 2): NAN})}
        yield case(f"NaN in {end}", f"error: lower.npy: {expected}", **damaged)
    yield case(
        "damaged where undecided",
        f"error: lower.npy: {at} 0.875, upper 0.75",
        lower=filled(0.25, at={(0, 1, 2): 0.875}),
        undecided=filled(0, "u1", {(0, 1): 1}, (2, 3)),
    )
    yield case(
        "marks",
        "error: undecided.npy: is damaged: it has a 7, not just 0 and 1",
        undecided=filled(1, "u1", {(1, 1): 7}, (2, 3)),
    )
    other = "error: upper.npy: has 3 x 2 pixels of 2 lanes, not 3 x 2 of 3"
    yield case("other lanes", other, upper=filled(0.75, shape=(2, 3, 2)))
    other = "error: undecided.npy: has 3 x 2 pixels of 3 lanes, not 3 x 2 of 1"
    yield case("marks for lanes", other, undecided=filled(0, "u1"))
    other = "error: undecided.npy: has 2 x 3 pixels of 1 lanes, not 3 x 2 of 1"
    yield case("marks of another size", other, undecided=filled(0, "u1", shape=(3, 2)))
    for name, type_, wanted in (
        ("lower", "f4", "<f8"),
        ("upper", "u1", "<f8"),
        ("undecided", "u2", "|u1"),
    ):
        shape = (2, 3) if name == "undecided" else SHAPE
        array = filled(0, type_, shape=shape)
        found = array.dtype.str
        expected = f"error: {name}.npy: has numbers of type {found}, not {wanted}"
        damaged = {name: array}
        yield case(f"{name} of type {type_}", expected, **damaged)
    for name in ("lower.npy", "upper.npy", "undecided.npy", "picture.npy"):
        yield case(f"no {name}", f"error: {name}: cannot be read", missing=name)


def headers() -> Iterator[Case]:
    data = filled(0.5).tobytes()
    usual = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3, 3), }    \n"
    yield case("version 2", GOOD, raw(usual, data, (2, 0)))
    yield case("version 3", GOOD, raw(usual, data, (3, 0)))
    for name, header in {
        "another order": "{'shape': (2, 3, 3), 'descr': '<f8', 'fortran_order': False}",
        "no spaces": "{'descr':'<f8','fortran_order':False,'shape':(2,3,3,)}",
        "many spaces": "{'descr' :  '<f8', 'fortran_order' : False, 'shape' : ( 2 , 3 , 3 , ) }",
        "lines": "{'descr':\n'<f8',\n'fortran_order':\nFalse,\n'shape':\n(2,\n3,\n3)\n}\n",
    }.items():
        yield case(f"a header with {name}", GOOD, raw(header, data))
    damaged = "error: picture.npy: has a damaged header"
    for name, header, expected in (
        ("no text", "{'descr': '<f8', \xe9}", damaged),
        ("nothing", "", f"{damaged}: no descr"),
        ("no descr", usual.replace("descr", "type"), f"{damaged}: no descr"),
        ("records", usual.replace("'<f8'", "[('x', '<f8')]"), f"{damaged}: no descr"),
        ("no end of descr", "{'descr': '<f8", f"{damaged}: no descr"),
        ("no colon", usual.replace("order':", "order'"), f"{damaged}: no fortran_order"),
        ("no order", usual.replace("fortran", "row"), f"{damaged}: no fortran_order"),
        ("no shape", usual.replace("shape", "sizes"), f"{damaged}: no shape"),
        ("a list as shape", usual.replace("(2, 3, 3)", "[2, 3, 3]"), f"{damaged}: no shape"),
        ("no end of shape", usual.replace(")", ""), f"{damaged}: no shape"),
    ):
        yield case(f"a header with {name}", expected, raw(header, data))
    fortran = "error: picture.npy: is not in C order, row by row"
    yield case("columns first", fortran, raw(usual.replace("False", "True"), data))
    yield case("columns first by NumPy", fortran, npy(np.asfortranarray(filled(0.5))))
    for type_ in (">f8", ">u2", "<i4", "|i1", "|b1", "<f16", "<c8", "|O", "<u1", "f8", ""):
        expected = f"error: picture.npy: has numbers of type {type_}; {KNOWN}"
        yield case(f"numbers of type {type_}", expected, raw(usual.replace("<f8", type_), data))
    yield case(
        "big-endian numbers by NumPy",
        f"error: picture.npy: has numbers of type >f4; {KNOWN}",
        npy(filled(0.5).astype(">f4")),
    )
    for shape in (
        "", ",", "6", "6,", "2, 3, 3, 1", "2,, 3", "2, 3, 3,,", "2, 3, 0", "0, 3, 3", "2, 3, 5",
        "2, -3, 3", "2, 3.0, 3", "2, 3, 3L", "2 3, 3", "+2, 3, 3", "65537, 3, 3", "2, 100000, 3",
        "2, 18446744073709551619, 3",
    ):  # fmt: skip
        expected = f"error: picture.npy: has the shape ({shape}), {NO_PICTURE}"
        yield case(f"the shape ({shape})", expected, raw(usual.replace("2, 3, 3", shape), data))


def lengths() -> Iterator[Case]:
    whole = npy(filled(0.5))
    none = "error: picture.npy: is no .npy file"
    for name, content in {
        "nothing": b"",
        "a PNG": b"\x89PNG\r\n\x1a\n" + bytes(100),
        "another magic": b"\x93NUMPZ" + whole[6:],
        "only a magic": whole[:6],
        "half a version": whole[:7],
    }.items():
        yield case(f"a file of {name}", none, content)
    for version in ((0, 0), (1, 1), (4, 0), (255, 255)):
        expected = "of the .npy format, not 1.0 to 3.0"
        number = ".".join(map(str, version))
        content = whole[:6] + bytes(version) + whole[8:]
        yield case(
            f"version {number}", f"error: picture.npy: has version {number} {expected}", content
        )
    damaged = "error: picture.npy: has a damaged header"
    for length in (8, 9, 10, 60, 127):
        yield case(f"only {length} bytes", damaged, whole[:length])
    longer = whole[:6] + b"\x02\x00" + b"\xff\xff\xff\xff" + whole[10:]
    yield case("a header of four gigabytes", damaged, longer)
    for change in (-144, -8, -1, 1, 8):
        content = whole[:change] if change < 0 else whole + bytes(change)
        expected = f"has {144 + change} bytes of numbers, but needs 144"
        yield case(f"{change:+} bytes", f"error: picture.npy: {expected}", content)
    huge = "{'descr': '<f8', 'fortran_order': False, 'shape': (65536, 65536, 4)}"
    expected = "has 4 bytes of numbers, but needs 137438953472"
    yield case("the largest size", f"error: picture.npy: {expected}", raw(huge, bytes(4)))
    cut = npy(filled(0.25))[:-1]
    expected = "error: lower.npy: has 143 bytes of numbers, but needs 144"
    yield case("lower bounds that are cut off", expected, lower=cut)


SOURCES = (
    floats, odd_numbers, small_and_large, codes, srgb, shapes, undecided, ties, damaged_bounds,
    headers, lengths,
)  # fmt: skip
CASES = tuple(each for source in SOURCES for each in source())
