"""Blending of a colour that is drawn with the one in the target, as the hardware does it.

Semantics reads it from the passes' targets (``semantics/shading/blending.py``), the reflection
hands it on to hosts, and the reference blends by it. A factor or an operation means what it does in
Vulkan, OpenGL, Direct3D and WebGPU, whose words these are.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Literal, get_args

from ...support.frozen import frozen
from ..constraints import dashed

Factor = Literal[
    "zero", "one", "src", "one_minus_src", "src_alpha", "one_minus_src_alpha", "dst",
    "one_minus_dst", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated", "constant",
    "one_minus_constant",
]  # fmt: skip
"""The factor of a side before both are joined.

The source is the colour that is drawn, the destination the one in the target.
"""
Operation = Literal["add", "subtract", "reverse_subtract", "min", "max"]
"""The operation that joins both products: ``subtract`` takes the destination from the source."""
Mask = Literal[
    "none", "r", "g", "b", "a", "rg", "rb", "ra", "gb", "ga", "ba", "rgb", "rga", "rba", "gba",
    "rgba",
]  # fmt: skip
"""The lanes of a target that are written."""

OF_ALPHA = frozenset(
    ("src_alpha", "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated")
)
"""The factors that are an alpha, or made of it: a target needs a fourth lane for them."""
OF_CONSTANT = frozenset(("constant", "one_minus_constant"))
"""The factors that are a number which a host sets for the whole pass."""
WITHOUT_FACTORS = frozenset(("min", "max"))
"""The operations that choose one of the two sides as they are."""


@frozen
class BlendEquation:
    """The equation of two colours, or of two alphas: ``source * src operation destination * dst``.

    Where the operation has no factors, both are ``one``, as WebGPU wants them.
    """

    WORDS: ClassVar = {
        "source": dashed(get_args(Factor)),
        "destination": dashed(get_args(Factor)),
        "operation": dashed(get_args(Operation)),
    }

    source: Factor = "one"
    """The factor of the colour that is drawn.

    ``src`` is the colour that is drawn, ``dst`` the one in the target, and ``constant`` the one
    that the host sets for the whole pass.
    """
    destination: Factor = "zero"
    """The factor of the colour in the target."""
    operation: Operation = "add"
    """The operation that joins the products: ``subtract`` takes the second one from the first."""

    @property
    def factors(self) -> tuple[Factor, Factor]:
        """Both factors, that of the source first."""
        return self.source, self.destination


@frozen
class Blend:
    """The blending of a target."""

    color: BlendEquation = BlendEquation()
    alpha: BlendEquation = BlendEquation()

    @property
    def factors(self) -> frozenset[Factor]:
        """All factors of both equations."""
        return frozenset((*self.color.factors, *self.alpha.factors))


REPLACES = Blend()
"""The colour that is drawn takes the place of the one in the target: nothing is blended."""


def _both(source: Factor, destination: Factor) -> Blend:
    equation = BlendEquation(source, destination)
    return Blend(equation, equation)


NAMED: Mapping[str, Blend] = {
    "none": REPLACES,
    "alpha": Blend(
        BlendEquation("src_alpha", "one_minus_src_alpha"),
        # Alpha is combined in the same way, but is not multiplied by itself.
        BlendEquation("one", "one_minus_src_alpha"),
    ),
    "premultiplied": _both("one", "one_minus_src_alpha"),
    "add": _both("one", "one"),
    "multiply": _both("dst", "zero"),
}
"""The states that have a name of their own in the language."""
