"""The cost of guards in the examples of local shading: instructions with them and without any.

The examples are those that ``examples/README.md`` lists under "Local shading". Each is compiled
twice; the second time every operation with a domain counts as safe, as hand-written code takes it
for granted. What remains in both is no guard: the clamped indices of arrays and texels, and what a
profile has to say in other operations.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from types import MappingProxyType
from unittest.mock import patch

import burnish
from burnish.api.entry_points import variants
from burnish.compiler.passes import guard
from burnish.stdlib.builtins import BUILTINS, Builtin
from burnish.stdlib.builtins.facts import Fact
from burnish.stdlib.builtins.row import Domain
from burnish.support.frozen import changed
from burnish.targets.toolchain import Job, Toolchain, count_instructions, optimise

from .table import Cell, Row, Section

EXAMPLES = Path(__file__).parents[2] / "examples"
MEDIAN_LIMIT = 1.1
STAGES = {"vertex": "vert", "fragment": "frag"}
ROUTES = {"glslang-vulkan": "glsl", "dxc-spirv": "hlsl"}
"""Downstream compilers, with the languages that they take. What glslang leaves is optimised."""

Counts = Mapping[tuple[str, str, bool], int]
"""Instructions of all stages, by subject, compiler, and whether there are guards."""


def measure() -> Iterator[Section]:
    """A row for each material of each example, and the medians of their ratios."""
    for stages, title in ((("fragment",), "fragment"), (tuple(STAGES), "vertex and fragment")):
        rows = _rows(_counted(stages))
        yield Section(
            f"guards of {title}", f"Instructions with guards and without, {title} shaders", rows
        )
        yield Section(f"median of {title}", "The median of the ratios", [_medians(rows)])


def local_shading() -> list[Path]:
    """The examples of local shading, in the order of the list."""
    text = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    section = text.split("## Local shading")[1].split("\n## ")[0]
    return [EXAMPLES / name for name in dict.fromkeys(re.findall(r"\]\((\w+\.burnish)\)", section))]


@contextmanager
def no_guards() -> Iterator[None]:
    """Has the pass ``guard`` take all operands for harmless."""
    rows = MappingProxyType({name: _trusted(row) for name, row in BUILTINS.items()})
    with patch.object(guard, "BUILTINS", rows):
        yield


def _trusted(row: Builtin) -> Builtin:
    return changed(row, domain=_unless_fractional(row.domain)) if row.needs else row


def _unless_fractional(domain: Domain) -> Domain:
    """A domain that trusts all operands except a remainder of floats.

    No language rounds that remainder down, so the operations that do it are no guard.
    """

    def trusted(facts: tuple[Fact, ...]) -> bool:
        return domain is not BUILTINS["mod"].domain or facts[0].kind != "float"

    return trusted


def _counted(stages: tuple[str, ...]) -> Counts:
    jobs: dict[tuple[str, str, bool, str], Job] = {}
    for path in local_shading():
        for subject, with_guards, material in _compiled(path):
            for checker, target in ROUTES.items():
                for stage in stages:
                    text = material.text(target, "vertex" if stage == "vertex" else "fragment")
                    key = subject, checker, with_guards, stage
                    jobs[key] = Job(checker, STAGES[stage], text, name=subject)
    with Toolchain() as toolchain:
        verdicts = toolchain.check(list(jobs.values()), keep_modules=True)
    counts: dict[tuple[str, str, bool], int] = {}
    for (subject, checker, with_guards, _), verdict in zip(jobs, verdicts, strict=True):
        if verdict.spirv is None:
            raise SystemExit(verdict.report())
        module = optimise(verdict.spirv) if checker == "glslang-vulkan" else verdict.spirv
        key3 = subject, checker, with_guards
        counts[key3] = counts.get(key3, 0) + count_instructions(module)
    return counts


def _compiled(path: Path) -> Iterator[tuple[str, bool, burnish.CompiledMaterial]]:
    """The materials of an example, under the first rig and the first pass that it can be drawn
    with; of each, whether it has guards."""
    rig, pass_ = variants(path)[0]
    for with_guards in (True, False):
        if with_guards:
            result = burnish.compile(path, tuple(ROUTES.values()), rig=rig, pass_=pass_)
        else:
            with no_guards():
                result = burnish.compile(path, tuple(ROUTES.values()), rig=rig, pass_=pass_)
        for material in result.materials:
            yield f"{path.stem}: {material.name}", with_guards, material


def _rows(counts: Counts) -> list[Row]:
    rows: list[Row] = []
    for subject in dict.fromkeys(subject for subject, _, _ in counts):
        row: dict[str, Cell] = {"example": subject}
        for checker in ROUTES:
            guarded, bare = counts[subject, checker, True], counts[subject, checker, False]
            row |= {
                checker: guarded, f"{checker}, none": bare, f"ratio, {checker}": guarded / bare
            }  # fmt: skip
        rows.append(row)
    return rows


def _medians(rows: list[Row]) -> Row:
    found = {checker: _median(rows, f"ratio, {checker}") for checker in ROUTES}
    within = max(found.values()) <= MEDIAN_LIMIT
    return {**found, f"at most {MEDIAN_LIMIT}": within}


def _median(rows: list[Row], column: str) -> float:
    return median(cell for row in rows if isinstance(cell := row[column], float))
