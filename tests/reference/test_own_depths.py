"""Depths that a pass gives its fragments, against values worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import FRAGMENT_DEPTH
from burnish.compiler.reference.picture import Geometry, RasterRules

from .kit import few_ulps, geometry, picture, shader

SIZE = 8
NEAR, FAR = 0.25, 0.75
RED, GREEN, BLACK = (1, 0, 0), (0, 1, 0), (0, 0, 0)


def passing(depth: str, more: str = "") -> Shader:
    return shader(f"""
        abstract material Base {{
            attribute place : vec4
            clip_position : vec4 = place
        }}
        material M : Base {{
            attribute tint : vec4
        }}
        pass P {{
            depth {{ {depth} }}
            clear {{ t = vec4(0), depth = 0.5 }}
            {more}
            target t : rgba32f = material.tint
        }}
        """, "P")  # fmt: skip


def faces(*depths: float) -> Geometry:
    """Triangles over the whole picture, the first of them red and the second one green."""
    corners = [(x, y, z, 1.0) for z in depths for x, y in ((-1, 1), (3, 1), (-1, -3))]
    tints = [(*tint, 1.0) for tint in (RED, GREEN)[: len(depths)] for _ in range(3)]
    triangles = np.arange(len(corners)).reshape(-1, 3)
    return geometry(triangles, place=np.array(corners), tint=np.array(tints, np.float64))


def seen(given: Shader, mesh: Geometry, *, is_certain: bool = True) -> tuple[float, ...]:
    """The colour of all pixels, and whether every device draws it."""
    found = picture(given, mesh, RasterRules(SIZE, SIZE), errors=few_ulps)
    colours = found.targets[0][..., :3]
    assert (found.undecided != is_certain).all() and (colours == colours[0, 0]).all()
    return tuple(colours[0, 0].tolist())


@pytest.mark.parametrize("order", [(NEAR, FAR), (FAR, NEAR)])
def test_own_depths_decide_what_is_in_front(order: tuple[float, float]) -> None:
    """Turned round, the far face is the only one that is before the depth of 0.5."""
    farther = (RED, GREEN)[int(order[1] == FAR)]
    assert seen(passing("value = 1 - frag_coord.z"), faces(*order)) == farther
    nearer = (RED, GREEN)[int(order[1] == NEAR)]
    assert seen(passing("value = frag_coord.z"), faces(*order)) == nearer


def test_of_equal_depths_the_first_one_stays() -> None:
    """A device may have rounded them apart."""
    first = passing("value = 0.25")
    assert seen(first, faces(FAR, NEAR), is_certain=False) == RED
    last = passing("value = 0.25, compare = less_equal")
    assert seen(last, faces(FAR, NEAR), is_certain=False) == GREEN


def test_faces_behind_are_drawn_if_their_depths_are_not_tested() -> None:
    assert seen(passing("value = 0.9, compare = always"), faces(NEAR)) == RED
    assert seen(passing("value = 0.9"), faces(NEAR)) == BLACK


def test_depths_are_limited_to_what_they_can_be() -> None:
    """Less than 0 is 0, which is not less than 0; and a bias moves no depth of a fragment's own."""
    below = "value = frag_coord.z - 5, compare = less"
    assert seen(passing(below), faces(NEAR)) == RED
    assert seen(passing(below), faces(NEAR, FAR), is_certain=False) == RED
    assert seen(passing("value = 0.499, bias = 16777216"), faces(NEAR)) == RED


def test_the_nearest_record_says_the_depth() -> None:
    derived = passing("value = 0.9", "depth { value = 0.1 }")
    assert seen(derived, faces(FAR)) == RED


def test_depths_that_count_for_nobody_are_not_computed() -> None:
    """They are checked like all others."""
    unused = "value = 0.9, compare = always, write = false"
    assert not passing(unused).results_of(FRAGMENT_DEPTH)
    assert seen(passing(unused), faces(NEAR)) == RED
    with pytest.raises(CompileError, match="expected float, found vec4"):
        passing(unused.replace("0.9", "frag_coord"))


def test_what_is_discarded_leaves_no_depth() -> None:
    given = passing("value = 0.5 * frag_coord.z", "discard when material.tint.x > 0.5")
    assert seen(given, faces(NEAR, FAR)) == GREEN
