"""Plans whose passes draw several views at once, and reflections that contradict them."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api.compiled import CompiledFrame
from burnish.compiler.documents.reflection import Reflection
from burnish.support.frozen import changed
from burnish.targets.runner.frames.checking import PlanError, check_plan

STEREO = Path(burnish.__file__).parent / "examples" / "frames" / "stereo.burnish"


def stereo(*, native: bool) -> CompiledFrame:
    (frame,) = burnish.compile(STEREO, "glsl:vulkan", native_stages=native).frames
    return frame


def reflections(frame: CompiledFrame) -> list[Reflection]:
    return [shader.reflection for shader in frame.shaders]


def with_layers(reflection: Reflection, **changes: object) -> Reflection:
    """A reflection that says something else of its layers, if it has any."""
    row = reflection.draw.layers
    if row is None:
        return reflection
    return changed(reflection, draw=changed(reflection.draw, layers=changed(row, **changes)))


@pytest.mark.parametrize("native", [True, False])
def test_each_view_is_a_layer(native: bool) -> None:
    frame = stereo(native=native)
    check_plan(frame.plan, reflections(frame))
    both = frame.plan.textures[0]
    assert (both.dimension, both.layers) == ("2d_array", 2)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"view_mask": 0b101}, "its view mask 5 is not that of all layers"),
        ({"view_mask": 0b1}, "its view mask 1 is not that of all layers"),
        ({"parameter": "draw.view_index"}, "its view mask 3 is not that of all layers"),
        ({"count": 3}, "it draws 3 layers to 2"),
    ],
)
def test_masks_that_are_not_those_of_the_targets(changes: dict[str, object], told: str) -> None:
    frame = stereo(native=True)
    wrong = [with_layers(each, **changes) for each in reflections(frame)]
    with pytest.raises(PlanError, match=told):
        check_plan(frame.plan, wrong)


def test_all_shaders_of_a_step_reach_the_same_layers() -> None:
    """One draw cannot be of one view while another one of the same pass is of all."""
    frame = stereo(native=True)
    first, *others = reflections(frame)
    wrong = [with_layers(first, view_mask=None), *others]
    with pytest.raises(PlanError, match="its shaders reach different layers by one draw"):
        check_plan(frame.plan, wrong)
