"""The shape of a row in the table of builtins.

A builtin is declared once, here in ``stdlib``; overload resolution, constant folding, range
analysis, guards, emission, the reference evaluator and the manual all read the same row.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from ...support.frozen import frozen
from .accuracy import INHERITED, Accuracy
from .facts import UNKNOWN, Fact

MeaningRule = Literal[
    "sum", "difference", "product", "quotient", "remainder", "negation",
    "numbers", "lanes", "limits", "blend", "change", "angle",
    "measure", "distance", "perpendicular", "unit", "reflected", "turned", "reversed",
    "texel", "of_texture",
]  # fmt: skip
"""``numbers`` come out as mere numbers; ``lanes`` and ``limits`` leave colours what they are.

A ``texel`` means what its texture declares, and whatever else is known ``of_texture`` is mere
numbers.
"""

RangeRule = Callable[[tuple[Fact, ...], bool], Fact]
"""A function from the operands' facts to the result's fact.

It is also told whether all operands are the same node.
"""

SamplerUse = Literal["filtering", "comparison"]
"""The way in which a sampler reads: it mixes texels, or the results of comparisons with them."""

Domain = Callable[[tuple[Fact, ...]], bool]
"""A predicate of facts: operands within them lie where something holds of an operation."""


GroupPart = Literal["all", "through", "before"]
"""The invocations of a work group whose values are joined.

They are all of them, those up to an invocation and itself, or those before it.
"""


@frozen
class OfGroup:
    """A builtin that joins the values of its operand in all invocations of a work group."""

    part: GroupPart
    joins: str
    """The builtin that joins two values."""


def anything(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    """The range rule that knows nothing."""
    return UNKNOWN


def everywhere(_facts: tuple[Fact, ...]) -> bool:
    """The domain of a function on which all backends agree everywhere."""
    return True


def nowhere(_facts: tuple[Fact, ...]) -> bool:
    """The domain of a function that no backend has: it is always expanded."""
    return False


@frozen
class Builtin:
    """One builtin function or operator.

    ``signatures`` are texts such as ``"T, T -> T"`` whose letters range over type families::

        T  floats: float, vec2, vec3, vec4        S  float
        V  vec2, vec3, vec4                       M  mat2, mat2x3 … mat4: any matrix
        C, O  a column and a row of M             A  M with rows and columns exchanged
        Z  a matrix with a row for each of the    Y  the product of M and Z
           columns of M
        N  numbers: floats and int, uint, ivec*, uvec*
        I  integers: int, uint, ivec*, uvec*      L  the scalar of N, I or T's lane kind
        B  bool, bvec2, bvec3, bvec4              P  any scalar or vector
        Q  the bools of P or N, lane by lane      U, J  the uints and ints of I or T, likewise
        R  any type that can be a value

        F  texture2d, texture3d, texture_cube     D  depth2d, depth_cube
        G  2d and 3d textures of every kind       H  *2d_array of every kind
        X  any texture                            K  the float vector that is F's or D's coordinate
        W  the ivec that is G's or X's size       E  what G or H holds: vec4, float, ivec4, uvec4

    The same letter stands for the same type throughout one signature; other words are type names.
    """

    name: str
    signatures: tuple[str, ...]
    doc: str
    operator: str = ""
    """Infix or prefix spelling common to all targets; empty for functions."""
    domain: Domain = everywhere
    """The operands for which the operation means the same in every language.

    They lie within what the mathematical function, or the machine's operation, is defined for. A
    language in which it does not says so in its profile (``Profile.agrees``).
    """
    needs: str = ""
    """The condition of ``domain`` on the operands, in words, for proofs.

    It is empty where there is nothing to prove, since types alone decide or the domain is
    ``nowhere``.
    """
    outside: str = ""
    """The meaning outside the naive domain, for the manual."""
    expansion: str = ""
    """Function of ``stdlib/meaning.burnish`` that has the defined meaning everywhere.

    It is used where ``domain`` is not proven. Inside it, ``unguarded(f(x))`` is the hardware's own
    ``f``.
    """
    by_profile: Domain = nowhere
    """Operands outside of ``domain`` for which some language defines the operation as Burnish.

    The call is then left to ``targets/legalise``, which looks at the promises of the profile.
    """
    is_promise: bool = False
    """True if it states a host's promise about its operand, and computes nothing.

    ``guard`` decides by its range, and then puts the operand in its place.
    """
    definition: str = ""
    """Function of ``stdlib/meaning.burnish`` that says the same in other operations.

    It is for profiles whose language lacks this one, or has it otherwise (``Profile.lacks``,
    ``Profile.agrees``).
    """
    range: RangeRule = anything
    accuracy: Accuracy = INHERITED
    meaning: MeaningRule = "lanes"
    """The rule of ``meaning_rules.py`` by which the operands' meanings make that of the result."""
    cost: int = 1
    """Rough price in ALU operations a lane, for choosing between a branch and a select."""
    short_circuits: bool = False
    """True if, for single bools, the second operand is left out where the first one decides."""
    uniform_control_flow: bool = False
    """True if it needs neighbours' values, or those of all other invocations of a work group.

    Neighbours' values are needed by derivatives, and by an implicit level of detail.
    """
    of_group: OfGroup | None = None
    """The way in which it joins the values of a work group, if it does.

    It then exists in kernels, and only there.
    """
    method: str | None = None
    """The name in a read of a texture: ``level`` in ``albedo.level(uv, 2)``.

    It is empty for ``albedo(uv)``, and ``None`` for other builtins.
    """
    parameters: tuple[str, ...] = ()
    """For reads, the names of the operands behind the texture.

    A layer, which only arrays have, would stand second.
    """
    optional: tuple[int, ...] = ()
    """For reads, the integers that the last operands are where they are left out."""
    sampler: SamplerUse | None = None
    """The kind of sampler that a read needs; none where it names texels, or asks for a size."""
    constants: tuple[int, ...] = ()
    """Operands, counted from the end (-1), that have to be constants in 0..3."""
    samples: tuple[tuple[float, ...], ...] = ()
    """Operand tuples worth testing beyond the usual ones (scalars; broadcast to vectors)."""

    @property
    def compares_pixels(self) -> bool:
        """True if it needs the values of neighbouring pixels."""
        return self.uniform_control_flow and self.of_group is None
