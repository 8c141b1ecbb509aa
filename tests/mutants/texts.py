"""``python -m tests.mutants.texts``: plant small errors in emitted texts, and see who notices.

This is what a user gains who conforms a material: an error in a text, wherever it comes from, must
show. Each change is one that somebody could make: operands exchanged, a constant a few units in the
last place off, other lanes, a guard left out, another index, qualifier or binding.

    python -m tests.mutants.texts --count 200 --seed 7 examples/*.burnish

For each kind of change the table says how many were planted, how many a compiler or driver refused,
of how many the picture ``differs``, how many leave only what was measured of the driver, which is a
remark, and how many the bounds allow; and of how many no pixel changes at all. Of those that the
bounds allow, it lists how much of its bound the worst pixel needs.
"""

from __future__ import annotations

import random
import re
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import burnish
from burnish.api import entry_points as api
from burnish.api.entry_points import CompiledMaterial
from burnish.support.frozen import changed
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

from .changes import Change

ROUTES_DRAWN = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga")
LAST_PLACES = 4
"""The change of a constant, in units in the last place of a float32."""


def _exchanged(found: re.Match[str]) -> str:
    return f"{found[3]}{found[2]}{found[1]}"


def _off_in_last_places(found: re.Match[str]) -> str:
    value = np.float32(found[0])
    if not value:
        return found[0]
    for _ in range(LAST_PLACES):
        value = np.nextafter(value, np.float32(np.inf))
    return repr(float(value))


def _other_lanes(found: re.Match[str]) -> str:
    lanes = found[1]
    return "." + (lanes[::-1] if lanes != lanes[::-1] else {"x": "y"}.get(lanes, "x" * len(lanes)))


def _next_number(found: re.Match[str]) -> str:
    number = int(found[2])
    return f"{found[1]}{number - 1 if number else 1}{found[3]}"


_OPPOSITES = {
    "min": "max", "max": "min", "sin": "cos", "cos": "sin", "floor": "ceil", "ceil": "floor",
    "round": "floor", "exp": "exp2", "exp2": "exp", "log": "log2", "log2": "log", "abs": "-",
    "normalize": "", "saturate": "", "sqrt": "", "fract": "floor", "frac": "floor", "sign": "",
    "asin": "acos", "acos": "asin", "length": "any", "transpose": "", "inversesqrt": "sqrt",
    "rsqrt": "sqrt", "inverseSqrt": "sqrt",
}  # fmt: skip
_OTHER = {
    " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ",
    " < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ",
    " == ": " != ", " != ": " == ", " && ": " || ", " || ": " && ",
}  # fmt: skip
_OPERAND = r"[\w.]+(?:\[\w+\])?(?:\.\w+)?"
_ORDERED = r"(?<!max\()(?<!min\()(?<!dot\()(?<!layout\()(?<=\()"
"""The beginning of arguments of which the order matters."""

Kind = tuple[str, str, Callable[[re.Match[str]], str]]

KINDS: Sequence[Kind] = (
    ("operand order", rf"({_OPERAND})( [-/] )({_OPERAND})", _exchanged),
    ("operator", r" (?:[-+*/<>]|<=|>=|==|!=|&&|\|\|) ", lambda found: _OTHER[found[0]]),
    ("constant", r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?(?![\w.])", _off_in_last_places),
    ("lanes", r"\.([xyzw]{1,4})\b", _other_lanes),
    ("guard", r"\b(?:max|min|clamp)\(([^(),]+), [^()]+\)", lambda found: f"({found[1]})"),
    ("guard", r"\(([^()?:]+) \? ([^()?:]+) : ([^()?:]+)\)", lambda found: f"({found[2]})"),
    ("guard", r"\bselect\(([^(),]+), ([^(),]+), [^()]+\)", lambda found: f"({found[2]})"),
    ("function", rf"\b({'|'.join(_OPPOSITES)})(?=\()", lambda found: _OPPOSITES[found[1]]),
    ("arguments", rf"{_ORDERED}([^(),]+)(, )([^(),]+)(?=[,)])", _exchanged),
    ("index", r"(\[)(\d+)(\])", _next_number),
    ("qualifier", r"\b(?:flat|nointerpolation) |@interpolate\(flat\) ", lambda _found: ""),
    ("qualifier", r"(?<=\) )in (?=vec|float)", lambda _found: "noperspective in "),
    ("qualifier", r"(?<=^    )(?=float\d? v_)", lambda _found: "noperspective "),
    ("qualifier", r"(@location\(\d+\) )(?=v_)", lambda found: f"{found[1]}@interpolate(linear) "),
    ("qualifier", r"column_major", lambda _found: "row_major"),
    ("binding", r"(binding = |@binding\(|register\([bts])(\d+)(\b)", _next_number),
    ("location", r"(\bin \w+ |location = |@location\(|LOC)(\d+)(\b)", _next_number),
    ("members", r"^( {4}\w+:? \w+[;,]).*(\n)( {4}\w+:? \w+[;,]).*$", _exchanged),
)  # fmt: skip
"""The kinds of changes, where each can be made, and what replaces what is found."""


def text_changes(text: str, kinds: Sequence[Kind] = KINDS) -> list[Change]:
    """All changes of a text, in the order of kinds; none of comments."""
    found: dict[Change, None] = {}
    for kind, pattern, replacement in kinds:
        for match in re.finditer(pattern, text, re.MULTILINE):
            line = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
            change = Change(*match.span(), replacement(match), kind)
            if "//" not in line and change.applied(text) != text:
                found[change] = None
    return list(found)


@dataclass(frozen=True, slots=True)
class Changed:
    """A material, one text of which has a change."""

    material: CompiledMaterial
    route: str
    file: int
    change: Change

    def __str__(self) -> str:
        file = self.material.files[self.file]
        return f"{self.route} {file.name}:{self.change.told(file.text)}"

    def subject(self) -> CompiledMaterial:
        """The material with the change."""
        files = list(self.material.files)
        file = files[self.file]
        files[self.file] = changed(file, text=self.change.applied(file.text))
        return changed(self.material, files=tuple(files))


def changes_of(
    material: CompiledMaterial, route: str, kinds: Sequence[Kind] = KINDS
) -> Iterator[Changed]:
    """All changes of the texts of a material that a route draws."""
    for number, file in enumerate(material.files):
        if f"{file.target}:{file.profile}" == ROUTES[route].profile:
            for change in text_changes(file.text, kinds):
                yield Changed(material, route, number, change)


def chosen(found: Sequence[Changed], count: int, chance: random.Random) -> list[Changed]:
    """A choice of ``count`` changes, with as many as possible of each kind."""
    kinds: dict[str, list[Changed]] = defaultdict(list)
    for each in chance.sample(found, len(found)):
        kinds[each.change.kind].append(each)
    picked: list[Changed] = []
    while len(picked) < count and any(kinds.values()):
        picked += [rows.pop() for rows in kinds.values() if rows]
    return picked[:count]


def _verdict(row: Row, unchanged: Row) -> str:
    if row.status in ("failed", "differs"):
        return {"failed": "refused"}.get(row.status, row.status)
    pairs = zip(row.results, unchanged.results, strict=True)
    if all(np.array_equal(one.got, other.got, equal_nan=True) for one, other in pairs):
        return "same picture"
    remarks = any(result.comparison.beyond for result in row.results)
    return "remark" if remarks else "allowed"


def _needed(row: Row) -> float:
    """The largest share of its bound that a pixel needs."""
    return max((result.comparison.excess for result in row.results), default=0.0)


def main() -> None:
    """Plant as many errors as the command line asks for."""
    parser = ArgumentParser(
        prog="python -m tests.mutants.texts", description=__doc__,
        formatter_class=RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("materials", type=Path, nargs="+")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=20, help="in each material, on each route")
    asked = parser.parse_args()
    chance, counts = random.Random(asked.seed), defaultdict[str, Counter[str]](Counter)
    profiles = [ROUTES[route].profile for route in ROUTES_DRAWN]
    with Runner([ROUTES[route] for route in ROUTES_DRAWN]) as runner, Toolchain() as toolchain:
        for path in asked.materials:
            for _rig, pass_ in api.variants(path):
                materials = burnish.compile(path, profiles, pass_=pass_, partial=True).materials
                for material in materials if pass_ is not None else ():
                    for route in ROUTES_DRAWN:
                        found = list(changes_of(material, route))
                        planted = chosen(found, asked.count, chance)
                        subjects = [(str(each), each.subject()) for each in planted]
                        label = f"{path.stem}: {pass_}"
                        (unchanged, *rows) = conform(
                            [(label, material), *subjects], [ROUTES[route]], runner, toolchain
                        )
                        if unchanged.status in ("failed", "differs"):
                            print(f"{label}, {route}: {unchanged.status} without a change")
                            continue
                        for each, row in zip(planted, rows, strict=True):
                            verdict = _verdict(row, unchanged)
                            counts[each.change.kind][verdict] += 1
                            print(f"{verdict:12} {_needed(row):8.3g} {label} {each}", flush=True)
    for kind, counter in counts.items():
        told = ", ".join(f"{number} {verdict}" for verdict, number in counter.most_common())
        print(f"{kind:14} {sum(counter.values()):5} planted: {told}")


if __name__ == "__main__":
    main()
