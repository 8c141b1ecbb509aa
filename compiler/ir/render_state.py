"""The state of the pipeline that a pass asks for, beside the code of its shaders.

Semantics reads it from the passes' members, and the reflection hands it on to hosts. The reference
draws by it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal, get_args

from ...support.frozen import frozen
from ..constraints import Range, Spelling, dashed

Cull = Literal["none", "back", "front"]
"""The faces that are not drawn."""
Winding = Literal["counter_clockwise", "clockwise"]
"""The order of the corners of a face whose front is seen."""
WINDING_WORDS: Mapping[Winding, Literal["ccw", "cw"]] = {
    "counter_clockwise": "ccw", "clockwise": "cw",
}  # fmt: skip
"""WebGPU's words for it, ``GPUFrontFace``."""
Fill = Literal["faces", "lines"]
"""The part of a face that is drawn: all of it, or its edges."""
Samples = Literal[1, 4]
SAMPLES: tuple[Samples, ...] = (1, 4)
"""The possible numbers of samples of a pixel: every API has these two."""
Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""The comparison of a number of the fragment, on the left, with the one in the attachment."""
COMPARE_WORDS: Spelling = dashed(get_args(Compare))
StencilOperation = Literal[
    "keep", "zero", "replace", "invert",
    "increment_clamp", "decrement_clamp", "increment_wrap", "decrement_wrap",
]  # fmt: skip
"""The change of a stencil value."""

HANGS_ON_EQUAL: frozenset[Compare] = frozenset(
    ("equal", "less_equal", "not_equal", "greater_equal")
)
"""The comparisons by which a pass draws again where another one has drawn.

For them it matters whether two depths are the same number.
"""

STENCIL_MOST = 255
"""The largest stencil value: all APIs have eight bits."""
StencilValue = Annotated[int, Range(0, STENCIL_MOST)]
"""Eight bits."""
MOST_BIAS = 1 << 24
"""The largest bias in steps, up to which floats count them without gaps."""


@frozen
class DepthState:
    """The depth test: its comparison, whether depths are kept, and the depth bias before it."""

    WORDS: ClassVar = {"compare": COMPARE_WORDS}

    compare: Compare = "less"
    """The comparison of a fragment's depth, on the left, with the one in the attachment.

    The fragment is drawn if it holds.
    """
    write: bool = True
    """True if the depths of the fragments that are drawn are kept."""
    clear: Annotated[float, Range(0, 1)] = 1.0
    """The depth of all pixels before anything is drawn."""
    bias: int = 0
    """A constant bias, in steps of the format at the farthest corner of the face.

    Lines of a mesh are never moved.
    """
    slope_bias: float = 0.0
    """A bias as a multiple of the depth's change from one pixel to the next."""
    bias_clamp: float = 0.0
    """The limit of both together: an upper one if positive, a lower one if negative; 0 for none."""

    @property
    def is_used(self) -> bool:
        """True if a pass uses depths at all: frames then give it an attachment for them."""
        return self.write or self.compare != "always"

    @property
    def keeps_nearest(self) -> bool:
        """True if of several fragments at a place only the nearest one is left."""
        return self.write and self.compare == "less"

    @property
    def is_biased(self) -> bool:
        """True if faces are moved."""
        return bool(self.bias or self.slope_bias)


@frozen
class StencilSide:
    """The stencil test of faces seen from one side, and the changes of the values."""

    WORDS: ClassVar = {
        "compare": COMPARE_WORDS,
        **dict.fromkeys(
            ("fail_op", "depth_fail_op", "pass_op"), dashed(get_args(StencilOperation))
        ),
    }

    compare: Compare = "always"
    """The comparison of the reference, on the left, with the value, both masked."""
    fail_op: StencilOperation = "keep"
    """The operation where that comparison fails."""
    depth_fail_op: StencilOperation = "keep"
    """The operation where only the depth test fails."""
    pass_op: StencilOperation = "keep"
    """The operation where both tests let the fragment through."""

    @property
    def operations(self) -> frozenset[StencilOperation]:
        """All operations that may change a value."""
        return frozenset((self.fail_op, self.depth_fail_op, self.pass_op))


@frozen
class StencilState:
    """The stencil test, for either side."""

    front: StencilSide = StencilSide()
    back: StencilSide = StencilSide()
    """Lines have no back."""
    reference: StencilValue = 0
    """The number that values are compared with, and that ``replace`` writes."""
    read_mask: StencilValue = STENCIL_MOST
    """The bits that are compared."""
    write_mask: StencilValue = STENCIL_MOST
    """The bits that are written."""

    @property
    def writes(self) -> bool:
        """True if values may change."""
        operations = self.front.operations | self.back.operations
        return bool(self.write_mask and operations - {"keep"})

    @property
    def tests(self) -> bool:
        """True if some value may keep a fragment from being drawn."""
        return any(side.compare != "always" for side in (self.front, self.back))

    @property
    def is_used(self) -> bool:
        """True if a pass uses stencil values at all."""
        return self.tests or self.writes


@frozen
class RenderState:
    """The state that a host sets for all draws of a pass.

    The defaults hold where the pass says nothing.
    """

    cull: Cull = "none"
    front: Winding = "counter_clockwise"
    fill: Fill = "faces"
    invariant: bool | None = None
    """True if all shaders that compute a position in the same way get the same one, to the bit.

    ``None`` leaves it to the comparison of the pass's depths.
    """
    samples: Samples = 1
    """The number of places of a pixel where visibility is decided, one of ``SAMPLES``."""
    alpha_to_coverage: bool = False
    """True if a fragment covers a share of these that its alpha in the first target says."""
    depth: DepthState = DepthState()
    stencil: StencilState = StencilState()

    @property
    def is_invariant(self) -> bool:
        """True if positions are the same in all such shaders."""
        if self.invariant is None:
            return self.depth.compare in HANGS_ON_EQUAL
        return self.invariant
