"""What each language says of itself: records that ``targets/<name>/target.py`` fills in.

To add a language, make a folder beside the others with a ``target.py`` that defines ``TARGET``, a
``reserved.txt`` and the skeleton named by ``Target.template``. Nothing else has to change: the
registry finds the folder. What has a default here is C-like. ``forms.py`` explains the templates.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal

from ...compiler.ir.stages import RASTERISED, STAGES, Chain
from ...compiler.ir.types import Dimension, Sample, ScalarKind, Type
from ...frozen import EMPTY, frozen
from ...stdlib.builtins.row import Domain, SamplerUse
from .forms import Forms
from .reserved import Reserved

STAGE_STRUCTS = tuple(
    f"{name.capitalize()}{side}" for name in STAGES for side in ("Input", "Output")
)
"""What the skeleton calls the structs of a stage's inputs and outputs, where a language has any."""

FieldRole = Literal["attribute", "varying", "render target"]
"""Vertex input, value between the stages, or render target."""

BindingKind = Literal["block", "texture", "sampler"]
"""What a host binds; a texture and a sampler in one are a texture."""

Numbering = Literal["set", "kind"]
"""The bindings of a set, whatever is bound; or, where there are no sets, those of one kind."""


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


@frozen
class PipelineInput:
    """A value that the pipeline supplies."""

    type: Type
    """As the target has it; converted where a program wants another kind."""
    read: str
    """Template; ``{name}`` is the declared name."""
    semantic: str = ""
    """What marks its declaration; empty where it needs none."""
    host_uniform: str = ""
    """A loose uniform of type float that ``read`` needs and the host has to set."""


GROUP_SETS: Mapping[str, int] = {"frame": 0, "view": 0, "rig": 1, "material": 2, "draw": 3}
"""Bind group of each parameter group: WebGPU guarantees four."""


@frozen
class Lack:
    """Something that a profile has not got."""

    feature: str
    """Behind "… has no"."""
    instead: str
    """What a user can do."""


@frozen(kw_only=True)
class Samplers:
    """How textures and their samplers belong together."""

    combined: bool = False
    """A texture and its sampler are one object with one binding."""
    joined: str = ""
    """Replaces ``Forms.texture``."""
    precision: str = ""
    """The line that opens a file for each ``{type}`` of combined samplers in it."""


@frozen(kw_only=True)
class Framebuffer:
    """Where clip space and the rows of a picture point, and what has to be turned over for that."""

    clip_depth: Literal["0..1", "-1..1"] = "0..1"
    """Depth range of clip space; Burnish's own is 0..1."""
    clip_y_down: bool = False
    """The API's own clip y points down: a host turns the viewport over for a program that was not
    emitted flipped, and only for that, so that either comes out the right way round."""
    rows_up: bool = False
    """The first row is the bottom one, unless the program was emitted flipped."""
    inputs: Mapping[str, PipelineInput] = EMPTY
    """How the pipeline's values are read while rows count upwards."""
    natives: Spellings = EMPTY
    """Spellings of natives while rows count upwards."""


@frozen
class Limits:
    """What every device of a profile has at least."""

    varyings: int = 16
    """Vectors that cross between the stages."""
    attributes: int = 16
    """Locations of vertex inputs."""
    textures: int = 16
    """Textures with their samplers that one stage reads."""
    block_bytes: int = 16384
    """Bytes of one uniform block."""
    render_targets: int = 8
    """Render targets that a pass writes."""
    groups: int | None = None
    """Bind groups, where there is a limit; for the host's own blocks, which say theirs."""
    bindings: int | None = None
    """Numbers of bindings in a group; likewise."""


@frozen(kw_only=True)
class Profile:
    """One dialect of a language: what an API or a version of it takes."""

    name: str
    doc: str
    preamble: tuple[str, ...] = ()
    """Lines that open each file: version, extensions, default precisions."""
    requires: Mapping[str, str] = EMPTY
    """By native, the line that opens a file in which it is used."""
    stages: Chain = RASTERISED
    """Those that it has, in any order."""
    single_file: bool = False
    """All stages can stand in one text."""
    samplers: Samplers = Samplers()
    framebuffer: Framebuffer = Framebuffer()
    limits: Limits = Limits()
    varyings_by_name: bool = False
    """Stages are matched by the names of varyings instead of their locations."""
    explicit_bindings: bool = True
    """The text states set and binding; otherwise the host assigns them by name."""
    numbering: Numbering = "set"
    """Within what no two blocks, textures and samplers have the same binding."""
    sets: Mapping[str, int] = GROUP_SETS
    default_set: int = 2
    """Where a user's own groups go."""
    natives: Spellings = EMPTY
    """Spellings that only this profile has."""
    inputs: Mapping[str, PipelineInput] = EMPTY
    """Inputs that this profile has otherwise than its language."""
    lacks: frozenset[str] = frozenset()
    """Builtins that the dialect has no word for: each becomes a function of the text, made from
    the builtin's ``definition``."""
    agrees: Mapping[str, Domain] = EMPTY
    """By builtin, the operands for which the dialect's own operation has Burnish's meaning, where
    these are others than the builtin's ``domain``. They are more if the language defines what
    others leave open; then it needs fewer guards. They are fewer if it has the operation for some
    types only, or a compiler of it gets it wrong; elsewhere the ``definition`` is used."""
    cannot: Mapping[str, Lack] = EMPTY
    """Natives that the profile has not got, nor an exact replacement for."""
    checkers: tuple[str, ...] = ()
    """Checkers of ``targets.toolchain`` that have to accept the text."""


def no_semantic(_role: FieldRole, _name: str, _location: int) -> str:
    """For languages in which locations or names say everything."""
    return ""


@frozen(kw_only=True)
class Target:
    """One shading language."""

    name: str
    title: str
    """The language's name in prose."""
    folder: Path
    """Where the skeleton lies."""
    template: str
    """The skeleton's file name."""
    extension: str
    types: TypeNames
    textures: TextureNames
    profiles: tuple[Profile, ...]
    """The first is the default."""
    unproven: str = ""
    """Why nobody should rely on its texts yet: "never compiled by …". Such a language is not among
    those that a material is compiled for when none is named, and is listed with this."""
    entry_point: str = "main"
    """What a text of one stage calls its entry point; ``{entry}`` is what it is called where
    several stages stand in one text."""
    reserved: Callable[[], Reserved]
    """Loads the words that cannot be names; called on first use."""
    literals: Literals = Literals()
    forms: Forms = Forms()
    natives: Spellings = EMPTY
    helpers: Mapping[str, Mapping[Dimension, str]] = EMPTY
    """Functions that natives call where the language has only statements; ``{texture}`` is the
    type of the texture that each takes."""
    splats: frozenset[str] = frozenset()
    """Natives whose scalar operands have to be vectors like the result: ``clamp(v, 0.0, 1.0)``."""
    inputs: Mapping[str, PipelineInput] = EMPTY
    """How the inputs of the stages that its profiles have are spelled."""
    semantic: Callable[[FieldRole, str, int], str] = no_semantic
    """What marks a field in the text, from its role, name and location."""
    registers: Mapping[BindingKind, str] = EMPTY
    """What the language calls a ``{binding}`` of each kind: ``t{binding}``. The reflection lists
    them."""
    resource_arguments: bool = False
    """Blocks, textures and samplers are no global variables: an entry point gets them as arguments,
    and hands each function those that it reads."""
    global_members: bool = True
    """Members of blocks are names of the whole file, so they must differ from all others."""
    global_fields: bool = False
    """Inputs and outputs are global variables and not members of structs."""
    varying_prefix: str = ""
    """Keeps global varyings and locals apart, which tend to have the same name."""
    output_prefix: str = ""
    """The same for render targets."""
    fixed_names: tuple[str, ...] = ()
    """Names that the skeleton uses itself."""
    line_directive: str = ""
    """Says which line of which file the next one is, by ``{line}`` and the file's ``{name}`` or
    ``{number}``; empty where the language has no such thing."""

    def register(self, kind: BindingKind, binding: int) -> str:
        """A binding in the language's own words; empty where it has none."""
        return self.registers.get(kind, "").format(binding=binding)

    def profile(self, name: str = "") -> Profile:
        """The profile called ``name``, or the default; ``KeyError`` if there is none."""
        if not name:
            return self.profiles[0]
        for profile in self.profiles:
            if profile.name == name:
                return profile
        raise KeyError(name)
