"""The state of the pipeline that a pass asks for, beside what its shaders compute.

Semantics reads it from the passes' members, and the reflection hands it on to hosts. The reference
draws by it.
"""

from __future__ import annotations

from typing import Annotated, Literal

from ...frozen import frozen
from ..constraints import Range

Cull = Literal["none", "back", "front"]
"""Which faces are not drawn."""
Winding = Literal["counter_clockwise", "clockwise"]
"""How the corners of a face go around if its front is seen."""
Fill = Literal["faces", "lines"]
"""What is drawn of a face: all of it, or its edges."""
Samples = Literal[1, 4]
SAMPLES: tuple[Samples, ...] = (1, 4)
"""How many samples a pixel may have: every API has these two."""
Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""How a number of the fragment, on the left, has to compare with the one that is there."""
StencilOperation = Literal[
    "keep", "zero", "replace", "invert",
    "increment_clamp", "decrement_clamp", "increment_wrap", "decrement_wrap",
]  # fmt: skip
"""What becomes of a stencil value."""

HANGS_ON_EQUAL: frozenset[Compare] = frozenset(
    ("equal", "less_equal", "not_equal", "greater_equal")
)
"""The comparisons by which a pass finds again what another one has drawn: for them it matters
whether two depths are the same number."""

STENCIL_MOST = 255
"""The largest stencil value: all APIs have eight bits."""
StencilValue = Annotated[int, Range(0, STENCIL_MOST)]
"""Eight bits."""
MOST_BIAS = 1 << 24
"""The largest bias in steps, up to which floats count them without gaps."""


@frozen
class DepthState:
    """Which fragments the depth test lets through, whether their depths are kept, and how far
    faces are moved away from the eye before."""

    compare: Compare = "less"
    """How the depth of a fragment, on the left, has to compare with the one that is there, so that
    it is drawn."""
    write: bool = True
    """Whether the depths of the fragments that are drawn are kept."""
    clear: Annotated[float, Range(0, 1)] = 1.0
    """What depths are before anything is drawn."""
    bias: int = 0
    """In steps of the format, as it has them at the farthest corner of the face. Lines of a mesh
    are never moved."""
    slope_bias: float = 0.0
    """In times of what the depth changes from one pixel to the next."""
    bias_clamp: float = 0.0
    """How far both together move at most if it is positive, or at least if it is negative; 0 for
    any distance."""

    @property
    def is_used(self) -> bool:
        """Whether a pass has to do with depths at all: frames give it an attachment for them."""
        return self.write or self.compare != "always"

    @property
    def keeps_nearest(self) -> bool:
        """Whether of several fragments at a place only the nearest one is left."""
        return self.write and self.compare == "less"

    @property
    def is_biased(self) -> bool:
        """Whether faces are moved."""
        return bool(self.bias or self.slope_bias)


@frozen
class StencilSide:
    """The stencil test of faces of which one side is seen, and what becomes of the values."""

    compare: Compare = "always"
    """How the reference, on the left, has to compare with the value, both masked."""
    fail_op: StencilOperation = "keep"
    """Where that fails."""
    depth_fail_op: StencilOperation = "keep"
    """Where only the depth test fails."""
    pass_op: StencilOperation = "keep"
    """Where both let the fragment through."""

    @property
    def operations(self) -> frozenset[StencilOperation]:
        """All that may become of a value."""
        return frozenset((self.fail_op, self.depth_fail_op, self.pass_op))


@frozen
class StencilState:
    """The stencil test, for either side."""

    front: StencilSide = StencilSide()
    back: StencilSide = StencilSide()
    """Lines have no back."""
    reference: StencilValue = 0
    """What values are compared with, and what ``replace`` writes."""
    read_mask: StencilValue = STENCIL_MOST
    """The bits that are compared."""
    write_mask: StencilValue = STENCIL_MOST
    """The bits that are written."""

    @property
    def writes(self) -> bool:
        """Whether values may change."""
        operations = self.front.operations | self.back.operations
        return bool(self.write_mask and operations - {"keep"})

    @property
    def tests(self) -> bool:
        """Whether some value may keep a fragment from being drawn."""
        return any(side.compare != "always" for side in (self.front, self.back))

    @property
    def is_used(self) -> bool:
        """Whether a pass has to do with stencil values at all."""
        return self.tests or self.writes


@frozen
class RenderState:
    """What a host sets for all that is drawn with a pass. The defaults hold for what no pass says
    anything of."""

    cull: Cull = "none"
    front: Winding = "counter_clockwise"
    fill: Fill = "faces"
    invariant: bool | None = None
    """Whether all shaders that compute a position in the same way get the same one, to the last
    bit; ``None`` where the pass leaves that to what its depths are compared for."""
    samples: Samples = 1
    """At how many places of a pixel it is decided what is seen there, one of ``SAMPLES``."""
    depth: DepthState = DepthState()
    stencil: StencilState = StencilState()

    @property
    def is_invariant(self) -> bool:
        """Whether positions are the same in all such shaders."""
        if self.invariant is None:
            return self.depth.compare in HANGS_ON_EQUAL
        return self.invariant
