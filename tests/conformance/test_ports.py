"""Ports of well-known shaders, written from the published formulas: what users bring along.

The examples have shaped the compiler and the bounds; these have not. So they show whether a verdict
holds for materials that nobody has tuned anything for.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import burnish
from burnish import api
from burnish.targets.toolchain import Job, Toolchain

from ..examples.kit import PROFILES as ALL_PROFILES
from .kit import FOLDER, Studio

PORTS = tuple(sorted((FOLDER / "ports").glob("*.burnish")))
STAGES = {"vertex": "vert", "fragment": "frag"}


def jobs(name: str) -> Iterator[Job]:
    """A job for each text of a port, for each of its rigs and passes and each checker."""
    (path,) = (path for path in PORTS if path.stem == name)
    for rig, pass_ in api.variants(path):
        result = burnish.compile(path, ALL_PROFILES, rig=rig, pass_=pass_)
        assert not result.diagnostics
        for material in result.materials:
            for file in material.files:
                for stage, entry in file.entry_points.items():
                    for checker in file.checkers:
                        yield Job(checker, STAGES[stage], file.text, entry, file.name)


@pytest.mark.parametrize("name", [path.stem for path in PORTS])
def test_every_compiler_accepts_it(name: str, studio: Studio) -> None:
    tools: Toolchain = studio.toolchain
    verdicts = tools.check(list(jobs(name)))
    refused = [verdict.report() for verdict in verdicts if verdict.status != "accepted"]
    assert not refused, "\n".join(refused)
    assert len(verdicts) >= len(ALL_PROFILES) * len(STAGES)
