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
from ...support.frozen import EMPTY, changed, frozen
from .binding_scheme import BindingKind
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
"""The role of a stage's input or output: a vertex attribute, a varying, a varying of a control
point that the stage hands on, a value that is the same for a whole patch, or a render target."""


def no_semantic(_role: FieldRole, _name: str, _location: int) -> str:
    """The semantic of languages in which locations or names are enough: none."""
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
    """The type of an image of a format that a kernel writes."""
    profiles: tuple[Profile, ...]
    """The first is the default."""
    unproven: str = ""
    """The reason why nobody should rely on the language's texts yet: "never compiled by …". Such a
    language is not compiled for unless it is named, and lists show the reason."""
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
    host_names: Mapping[str, str] = EMPTY
    """The names of uniforms and vertex inputs that a host sets by itself, by their names in
    Burnish. Nothing else has such a name."""
    splats: frozenset[str] = frozenset()
    """Natives whose scalar operands have to be vectors like the result: ``clamp(v, 0.0, 1.0)``."""
    inputs: Mapping[str, PipelineInput] = EMPTY
    """The spelling of the inputs that stages of the profiles have."""
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
    """True if blocks, textures and samplers are no global variables: an entry point gets them as
    arguments, and hands each function those that it reads."""
    buffer_blocks: bool = False
    """True if a storage buffer stands in an interface block, which has a name of its own."""
    global_members: bool = True
    """True if members of blocks are names of the whole file, so that they must differ from all
    others."""
    global_fields: bool = False
    """True if inputs and outputs are global variables and not members of structs."""
    varying_prefix: str = ""
    """A prefix of global varyings, since locals tend to have the same names."""
    point_prefix: str = ""
    """A prefix of the outputs by which a stage hands varyings of control points on, as its inputs
    have the same names."""
    output_prefix: str = ""
    """A prefix of render targets."""
    fixed_names: tuple[str, ...] = ()
    """Names that texts have besides the words of their skeleton and of these rows: those of helper
    functions, entry points and the structs of stages."""
    line_directive: str = ""
    """The line directive: gives the next line's number as ``{line}``, and its file's ``{name}`` or
    ``{number}``. Empty if the language has none."""

    def under(self, profile: Profile) -> Language:
        """The language with the rows that a profile replaces."""
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
