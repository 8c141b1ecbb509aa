"""The examples with every rig and pass that they declare."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.ir.stages import STAGES
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse
from burnish.targets.toolchain import Job

from ..targets.standings import PROFILES, profiles

FOLDER = Path(__file__).parents[2] / "examples"
EXAMPLES = tuple(sorted(FOLDER.glob("*.burnish")))
NEEDING: Mapping[str, str] = {
    "cloth": "kernels over buffers",
    "cloth.Linen": "storage buffers at vertices",
    "clusters": "kernels over buffers",
    "clusters.Hall": "storage buffers at fragments",
    "compaction": "kernels over buffers",
    "compaction.Chart": "storage buffers at fragments",
    "histogram": "kernels over buffers",
    "histogram.Compared": "storage buffers at fragments",
    "lanterns": "kernels over buffers",
    "lanterns.Wall": "storage buffers at fragments",
    "ray_tracer": "kernels over buffers",
    "street": "kernels over buffers",
    "street.Cobbles": "storage buffers at fragments",
    "swarm": "kernels over buffers",
    "swarm.Fly": "storage buffers at vertices",
    # Without a stage of its own for that, a capture is a kernel.
    "particles-Step": "kernels over buffers",
}
"""The capability that an example shows, if there are profiles without it.

The keys are examples, variants of them, or their materials and kernels.
"""
LACKING: Mapping[str, frozenset[str]] = {
    name: profiles("absent", capability) for name, capability in NEEDING.items()
}
"""Likewise, the profiles that lack what it shows."""


@dataclass(frozen=True)
class Variant:
    """An example with one of its own rigs and passes, or with the library's."""

    path: Path
    rig: str | None
    pass_: str | None

    def __str__(self) -> str:
        return "-".join(filter(None, (self.path.stem, self.rig, self.pass_)))

    def lacking(self, name: str) -> frozenset[str]:
        """The profiles that lack what a material or kernel called ``name`` shows."""
        names = (f"{self.path.stem}.{name}", f"{self}", self.path.stem)
        return next((LACKING[each] for each in names if each in LACKING), frozenset())

    def compile(self) -> burnish.CompileResult:
        """All its materials and kernels, each compiled for every profile that can have it."""
        return burnish.compile(self.path, PROFILES, rig=self.rig, pass_=self.pass_, partial=True)


def variants() -> Iterator[Variant]:
    """Every combination of an example, one of its rigs and one of its passes."""
    for path in EXAMPLES:
        declarations = parse(Source(path.name, path.read_text("utf-8")), Report()).declarations
        rigs: list[str | None] = [d.name.text for d in declarations if isinstance(d, ast.Rig)]
        records = [d for d in declarations if isinstance(d, ast.Record)]
        ties = {d.by.text for d in records if d.by is not None}
        passes = [d.name.text for d in records if d.kind == "pass" and d.name.text not in ties]
        for rig in rigs or [None]:
            for pass_ in (None, *passes):
                yield Variant(path, rig, pass_)


VARIANTS = tuple(variants())


def jobs_of(material: CompiledMaterial) -> Iterator[Job]:
    """The checks of a material by the compilers behind it: every stage, by each checker."""
    for file in material.files:
        for stage, entry in file.entry_points.items():
            for checker in file.checkers:
                yield Job(checker, STAGES[stage].suffix, file.text, entry, file.name)
