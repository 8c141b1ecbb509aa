"""The files that are mutated, by the part of the compiler or of the runtime that they belong to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import burnish

from .changes import Change, changes, statement_lines, template_changes

ROOT = Path(burnish.__file__).parent

AREAS: Mapping[str, tuple[str, ...]] = {
    "passes": ("compiler/passes/*.py", "compiler/passes/rules/*.py"),
    "ranges": ("compiler/ir/range*.py", "stdlib/builtins/intervals.py", "stdlib/builtins/facts.py"),
    "planning": ("compiler/planning/*.py",),
    "layout": ("compiler/layout.py", "compiler/packing.py", "compiler/ir/storage.py"),
    "reflection": ("compiler/reflection/*.py",),
    "legalise": ("targets/legalise/*.py",),
    "emit": ("targets/emit/*.py", "targets/emit/*.j2"),
    "languages": tuple(f"targets/{name}/*.{end}" for name in ("glsl", "hlsl", "wgsl") for end in
                       ("py", "j2")),
    "values": ("targets/runner/instances/*.py",),
    "textures": ("targets/runner/textures/*.py",),
    "scenes": ("targets/runner/scene*.py", "targets/runner/binding.py"),
    "frames": ("targets/runner/frames/by_route.py", "targets/runner/frames/job_resources.py",
               "targets/runner/frames/memory.py", "targets/runner/frames/states.py"),
    "drivers": ("targets/runner/drivers/vulkan/*.py", "targets/runner/drivers/readback.py"),
    "reference": ("compiler/reference/*.py", "compiler/reference/picture/*.py",
                  "targets/runner/frames/by_reference.py",
                  "targets/runner/frames/reference_textures.py"),
    "bounds": ("compiler/reference/bounds/*.py",),
}  # fmt: skip
"""The files of the package that each part has."""

DRAWING = frozenset({"drivers", "reference", "bounds"})
"""The parts that draw. Their mutants change pictures, but no texts and nothing that is told."""


@dataclass(frozen=True, slots=True)
class Mutant:
    """A file of the package with one change."""

    area: str
    path: str
    """Relative to the package."""
    change: Change

    @property
    def lines(self) -> range:
        """The lines of the statement that is changed, in a module of Python; none in a template."""
        if not self.path.endswith(".py"):
            return range(0)
        return statement_lines((ROOT / self.path).read_bytes(), self.change.start)

    def __str__(self) -> str:
        return f"{self.path}:{self.change.told((ROOT / self.path).read_bytes())}"


def mutants(area: str) -> list[Mutant]:
    """All mutants of one part, in the order of files and lines."""
    found = []
    for pattern in AREAS[area]:
        for path in sorted(ROOT.glob(pattern)):
            source = path.read_bytes()
            of_file = template_changes(source) if path.suffix == ".j2" else changes(source)
            name = path.relative_to(ROOT).as_posix()
            found += [Mutant(area, name, change) for change in of_file]
    return found
