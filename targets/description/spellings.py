"""Spellings of a language: types, textures, constants, builtins and the pipeline's inputs.

``targets/<name>/language.py`` fills these records in, and the printers of ``emit`` read them.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.ir.types import Dimension, Sample, ScalarKind, Type
from ...stdlib.builtins.row import SamplerUse
from ...support.frozen import EMPTY, frozen


@frozen
class Spelling:
    """The spellings of a native that depend on its operands; an empty one means ``usual``."""

    usual: str = ""
    """The spelling for all operands that have none of their own here."""
    floats: str = ""
    """The spelling for scalars or vectors of floats."""
    integers: str = ""
    """The spelling for scalars or vectors of integers."""
    vectors: str = ""
    """The spelling for vectors, whatever their lanes."""
    matrix: str = ""
    """The spelling if some operand is a matrix."""
    after: Mapping[str, str] = EMPTY
    """The spelling for a vector, by the builtin that has made the vector."""


@frozen
class Read:
    """The spellings of a texture read: ``plain``, unless one of the others fits."""

    plain: str
    layered: str = ""
    """The spelling if an operand is the layer."""
    types: Mapping[str, str] = EMPTY
    """The spelling by the texture's type: ``depth_cube``."""


Spellings = Mapping[str, str | Spelling | Read]
"""Spellings of natives for which neither the operator of their row nor their name will do.

Each is a name, ``lerp``, which is called with the operands; a symbol, ``==``, between two operands
or before one; or a form, ``clamp({0}, 0.0, 1.0)``, which reads as a call or stands in parentheses.
"""


@frozen
class TextureNames:
    """The types of textures and samplers; ``{dimension}`` is the word for the dimension."""

    dimensions: Mapping[Dimension, str]
    textures: Mapping[Sample, str]
    samplers: Mapping[SamplerUse, str]
    combined: Mapping[Sample, str] = EMPTY
    """The types of a texture and its sampler in one object, if the language has such."""
    compared: str = ""
    """The type of such an object whose sampler compares depths."""


@frozen
class TypeNames:
    """The names of types; ``{n}`` is a number of lanes, or of both columns and rows."""

    scalars: Mapping[ScalarKind, str]
    vectors: Mapping[ScalarKind, str]
    matrix: str
    """A square matrix."""
    rectangular_matrix: str
    """A matrix of ``{columns}`` and another number of ``{rows}``. Blocks store matrices of fewer
    columns than four as such, with four rows."""
    array: str = ""
    """``{element}`` and ``{count}``; empty where the count stands behind the variable's name."""
    declaration: str = "{type} {name}"
    stored_matrix: str = "{type}"
    """A matrix as a block's member, where its order has to be said: ``column_major {type}``."""
    stored: Mapping[str, str] = EMPTY
    """The type of members of blocks for a type whose variables have another size or alignment than
    in Burnish's layout: ``vec3``. ``Forms.stored`` reads such members."""


@frozen
class Literals:
    """The spelling of constants."""

    true: str = "true"
    false: str = "false"
    float_suffix: str = ""
    uint_suffix: str = "u"
    typed: Mapping[ScalarKind, str] = EMPTY
    """The spelling of both sides of a choice between two literals, and of a literal that is
    shifted, by kind. It is for languages whose literals have no type of their own, and would get
    one that is too wide."""


@frozen
class PipelineInput:
    """A value that the pipeline supplies."""

    type: Type
    """The type in the language. Programs may want its first lanes, or another kind of scalar."""
    read: str
    """The expression that reads the value; ``{name}`` is the declared name."""
    semantic: str = ""
    """The semantic or attribute of its declaration; empty if it needs none."""
    host_uniform: str = ""
    """A loose uniform of type float that ``read`` needs and the host has to set."""
    requires: str = ""
    """The line that opens a file in which the value is read."""
    unknown_to: frozenset[str] = frozenset()
    """The checkers of the profile that do not know the value, although the language has it."""
