"""Writes the types of textures and samplers, and other lines that a file needs to read textures."""

from __future__ import annotations

from collections.abc import Iterable

from ...compiler.ir.leaves import Texture
from ...compiler.ir.program import NativeUse, Program, TextureRead
from ...compiler.ir.types import TextureType
from ..description.profile import Profile
from ..description.shading_language import Language
from ..description.spellings import PipelineInput, TextureNames
from ..legalise.samplers import sampler_use, texture_type
from .views import ImageView


class TextureSpeller:
    """Writes the types of one program's textures."""

    def __init__(self, names: TextureNames, program: Program) -> None:
        self._names = names
        self._sampled = program.sampled

    def texture(self, texture: Texture) -> str:
        """The type of the texture alone."""
        type_ = texture_type(texture)
        return self._spelled(self._names.textures[type_.sample], type_)

    def sampler(self, texture: Texture) -> str:
        """The type of its sampler; empty if no read uses one."""
        if texture not in self._sampled:
            return ""
        return self._names.samplers[sampler_use(texture)]

    def combined(self, texture: Texture) -> str:
        """The type of an object that is both; empty if the language has none."""
        type_ = texture_type(texture)
        compared = texture in self._sampled and sampler_use(texture) == "comparison"
        form = self._names.compared if compared else self._names.combined.get(type_.sample, "")
        return self._spelled(form, type_)

    def _spelled(self, form: str, type_: TextureType) -> str:
        return form.format(dimension=self._names.dimensions[type_.dimension])


def opening_lines(
    profile: Profile,
    textures: TextureSpeller,
    natives: Iterable[NativeUse],
    reads: Iterable[TextureRead],
    inputs: Iterable[PipelineInput],
) -> list[str]:
    """The first lines of a file behind the preamble.

    They are the extensions that its operations and the pipeline's values need, default precisions,
    and the precisions of the textures that it reads.
    """
    used = (*(use.builtin for use in natives), *(read.builtin for read in reads))
    of_natives = (profile.requires[name] for name in used if name in profile.requires)
    extensions = (*of_natives, *(row.requires for row in inputs if row.requires))
    precision = profile.samplers.precision
    types = [textures.combined(read.texture) for read in reads] if precision else []
    precisions = (precision.format(type=type_) for type_ in types)
    found = dict.fromkeys((*extensions, *profile.defaults, *precisions))
    return [line for line in found if line not in profile.preamble]


def image_lines(profile: Profile, images: Iterable[ImageView]) -> list[str]:
    """The first lines of a file that writes images: their precision, if it has to be stated."""
    precision = profile.samplers.precision
    types = dict.fromkeys(image.type for image in images)
    return [precision.format(type=type_) for type_ in types] if precision else []


def helpers(
    language: Language, textures: TextureSpeller, reads: Iterable[TextureRead]
) -> list[str]:
    """The helper functions that the reads call, each a text of several lines."""
    found: dict[str, None] = {}
    for read in reads:
        forms = language.helpers.get(read.builtin)
        if forms is not None:
            form = forms[texture_type(read.texture).dimension]
            found[form.format(texture=textures.texture(read.texture))] = None
    return list(found)
