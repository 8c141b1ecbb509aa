"""Names of values that a user may set of a frame."""

from __future__ import annotations

import pytest

from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.instances.values import UnknownParameterError

from .kit import FOLDER, compiled


def test_only_what_can_be_set_is_suggested() -> None:
    """The frame itself sets `from_lamp` and `shadow` of its shaders, and `spread` by its own."""
    frame = compiled(FOLDER / "shadows.burnish")
    tags = {row.name: row.materials for row in frame.plan.models}
    host = FrameHost(frame, in_a_row(["Clay", "Slate"], tags, "cube"), (8, 8))
    with pytest.raises(UnknownParameterError) as error:
        host.set_text("nonsense", "1")
    assert str(error.value) == (
        "there is no parameter `nonsense`: there are object_to_world, ambient_light, base, lamp, "
        "view_projection, eye, size, number, spread"
    )
    host.set_text("spread", "2")
