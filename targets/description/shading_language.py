"""The record that describes a shading language: ``Language``.

To add a language, make a folder beside the others in ``targets`` with a ``language.py`` that
defines ``LANGUAGE``, a ``reserved.txt`` and the skeleton named by ``Language.skeleton``. Nothing
else has to change, since the registry finds the folder. What has a default here is C-like.
``forms.py`` explains the templates for single statements and expressions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Literal

from ...compiler.ir.kernel import ScatterOperator
from ...compiler.ir.stages import STAGES
from ...compiler.ir.tessellation import Patch, Spacing
from ...compiler.ir.types import Dimension
from ...frozen import EMPTY, changed, frozen
from .forms import Forms
from .profile import Profile
from .reserved import Reserved
from .spellings import Literals, PipelineInput, Spellings, TextureNames, TypeNames

STAGE_STRUCTS = tuple(
    f"{name.capitalize()}{side}" for name in STAGES for side in ("Input", "Output")
)
"""The skeleton's names for the structs of a stage's inputs and outputs, where a language has
any."""

FieldRole = Literal["attribute", "varying", "control point", "of patch", "render target"]
"""Vertex input, value between the stages, that of a control point which is handed on to the stage
after the next, what is the same all over a patch, or render target."""

BindingKind = Literal["block", "buffer", "written", "image", "texture", "sampler"]
"""The kinds of things that a host binds; a texture and a sampler in one are a texture."""


def no_semantic(_role: FieldRole, _name: str, _location: int) -> str:
    """For languages in which locations or names say everything."""
    return ""


@frozen(eq=False, kw_only=True)
class Language:
    """One shading language."""

    name: str
    title: str
    """The language's name in prose."""
    skeleton: Path
    """The Jinja2 template of a whole text."""
    extension: str
    types: TypeNames
    textures: TextureNames
    images: Mapping[str, str] = EMPTY
    """By format, how the type of an image is written that a kernel writes."""
    profiles: tuple[Profile, ...]
    """The first is the default."""
    unproven: str = ""
    """Why nobody should rely on its texts yet: "never compiled by …". Such a language is not among
    those that a material is compiled for when none is named, and is listed with this."""
    entry_point: str = "main"
    """The name of the entry point in a text of one stage. ``{entry}`` is its name in a text of
    several stages."""
    reserved: Callable[[], Reserved]
    """Loads the words that compilers refuse as names; called on first use. The words that texts
    have themselves need not be among them: ``emit/own_words.py`` finds these."""
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
    primitives: Mapping[str, str] = EMPTY
    """The language's words for the primitives that a geometry stage gets, if it has that stage."""
    patches: Mapping[Patch, str] = EMPTY
    """The language's words for the kinds of patches, if it has tessellation stages."""
    spacings: Mapping[Spacing, str] = EMPTY
    """The language's words for the ways in which the edges of patches are divided."""
    emitted: Mapping[str, str] = EMPTY
    """The language's words for the streams of points, lines and triangles that a geometry stage
    emits."""
    semantic: Callable[[FieldRole, str, int], str] = no_semantic
    """The semantic or attribute of a field in the text, from its role, name and location."""
    atomics: Mapping[ScatterOperator, str] = EMPTY
    """The functions by which kernels scatter."""
    registers: Mapping[BindingKind, str] = EMPTY
    """The language's own name of a ``{binding}`` of each kind: ``t{binding}``. The reflection lists
    them."""
    resource_arguments: bool = False
    """Blocks, textures and samplers are no global variables: an entry point gets them as arguments,
    and hands each function those that it reads."""
    buffer_blocks: bool = False
    """A storage buffer stands in an interface block, which has a name of its own."""
    global_members: bool = True
    """Members of blocks are names of the whole file, so they must differ from all others."""
    global_fields: bool = False
    """Inputs and outputs are global variables and not members of structs."""
    varying_prefix: str = ""
    """Keeps global varyings and locals apart, which tend to have the same name."""
    point_prefix: str = ""
    """The same for what a stage hands on of control points, which it also gets."""
    output_prefix: str = ""
    """The same for render targets."""
    fixed_names: tuple[str, ...] = ()
    """Names that texts have besides the words of their skeleton and of these rows: those of helper
    functions, entry points and the structs of stages."""
    line_directive: str = ""
    """Says which line of which file the next one is, by ``{line}`` and the file's ``{name}`` or
    ``{number}``; empty where the language has no such thing."""

    def under(self, profile: Profile) -> Language:
        """The language as a profile writes it, which may have rows of its own."""
        return _under(self, profile)

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


@cache
def _under(language: Language, profile: Profile) -> Language:
    """The language with the profile's rows in place of its own; itself if there are none."""
    own = {name: getattr(profile, name) for name in ("types", "literals", "forms", "skeleton")}
    own = {name: row for name, row in own.items() if row is not None}
    return changed(language, **own) if own else language
