"""The examples as ``burnish conform`` draws them, for tests that know a device's pictures."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

import burnish
from burnish.commands.compared import ConformRequest, subjects_of
from burnish.targets.conformance.cases import SIZE, series_of
from burnish.targets.runner.routes import select
from burnish.targets.runner.scene_state import SceneState

EXAMPLES = Path(burnish.__file__).parent / "examples"


@lru_cache(maxsize=1)
def subjects(file: str, folder: Path = EXAMPLES) -> dict[str, Any]:
    """The materials of an example for the routes to devices, by the label in the table."""
    request = ConformRequest(
        files=(folder / file,), routes="", device="", report=None, strict=False, explain=None,
        case=None, seed=0, rig=None, pass_=None, search_path=(), hoist=True, native_stages=False,
    )  # fmt: skip
    return dict(subjects_of(request, select(["vulkan,wgpu"]), native_stages=False))


def states(subject: Any) -> dict[str, SceneState]:
    """The states of a material's cases, by name."""
    return {
        case.name: case.state
        for series in series_of(subject.reflection, 0, SIZE)
        for case in series.cases
    }
