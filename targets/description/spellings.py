"""How a language writes types, textures, constants, builtins and the pipeline's inputs.

``targets/<name>/language.py`` fills these records in, and the printers of ``emit`` read them.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.ir.types import Dimension, Sample, ScalarKind, Type
from ...frozen import EMPTY, frozen
from ...stdlib.builtins.row import SamplerUse


@frozen
class Spelling:
    """How a native is spelled when that depends on the operands: empty means the usual way."""

    usual: str = ""
    """Whatever has no spelling of its own here."""
    floats: str = ""
    """Scalars or vectors of floats."""
    integers: str = ""
    """Scalars or vectors of integers."""
    vectors: str = ""
    """Vectors, whatever their lanes."""
    matrix: str = ""
    """Some operand is a matrix."""
    after: Mapping[str, str] = EMPTY
    """A vector, by the builtin that has made it."""


@frozen
class Read:
    """How a read of a texture is spelled: as ``plain`` unless one of the others fits."""

    plain: str
    layered: str = ""
    """Where an operand says which layer."""
    types: Mapping[str, str] = EMPTY
    """By the texture's type: ``depth_cube``."""


Spellings = Mapping[str, str | Spelling | Read]
"""How natives are spelled for which neither the operator of their row nor their name will do. Each
is a name, ``lerp``, which is called with the operands; a symbol, ``==``, between two operands or
before one; or a form, ``clamp({0}, 0.0, 1.0)``, which reads as a call or stands in parentheses.
"""


@frozen
class TextureNames:
    """How the types of textures and samplers are written, ``{dimension}`` as the word for it."""

    dimensions: Mapping[Dimension, str]
    textures: Mapping[Sample, str]
    samplers: Mapping[SamplerUse, str]
    combined: Mapping[Sample, str] = EMPTY
    """Both in one object, where the language has such."""
    compared: str = ""
    """Likewise, where the sampler compares depths."""


@frozen
class TypeNames:
    """How types are written; ``{n}`` is a number of lanes or columns."""

    scalars: Mapping[ScalarKind, str]
    vectors: Mapping[ScalarKind, str]
    matrix: str
    tall_matrix: str
    """A matrix of four rows, as blocks store smaller ones; ``{n}`` columns."""
    array: str = ""
    """``{element}`` and ``{count}``; empty where the count stands behind the variable's name."""
    declaration: str = "{type} {name}"
    stored_matrix: str = "{type}"
    """A matrix as a block's member, where its order has to be said: ``column_major {type}``."""
    stored: Mapping[str, str] = EMPTY
    """By type, what members of blocks have instead, where variables of that type have another size
    or alignment than Burnish's layout: ``vec3``. ``Forms.stored`` reads such members."""


@frozen
class Literals:
    """How constants are written."""

    true: str = "true"
    false: str = "false"
    float_suffix: str = ""
    uint_suffix: str = "u"
    typed: Mapping[ScalarKind, str] = EMPTY
    """By kind, how the sides of a choice between two literals are written, and a literal that is
    shifted, in a language whose literals have no type of their own: they would get one that is too
    wide."""


@frozen
class PipelineInput:
    """A value that the pipeline supplies."""

    type: Type
    """As the language has it. Programs may want the first lanes of it, or another kind."""
    read: str
    """Template; ``{name}`` is the declared name."""
    semantic: str = ""
    """The semantic or attribute of its declaration; empty if it needs none."""
    host_uniform: str = ""
    """A loose uniform of type float that ``read`` needs and the host has to set."""
