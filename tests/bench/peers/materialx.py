"""MaterialX generates ``standard_surface`` for three flavours of GLSL.

It is a large surface model of a library that MaterialX brings along, as a document makes it that
sets one input and leaves all others as they are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any

from .peer import MissingPeerError, Texts

GENERATORS = ("GlslShaderGenerator", "EsslShaderGenerator", "VkShaderGenerator")
"""The generators of texts for OpenGL, for OpenGL ES and for Vulkan."""
STAGES = ("vertex", "pixel")

FRESH, KEPT = "MaterialX, fresh", "MaterialX, kept"
_MODEL = "standard_surface to three flavours of GLSL, its library parsed before"
WAYS = {FRESH: f"{_MODEL}, with new contexts", KEPT: f"{_MODEL}, with contexts that stay"}
"""What is measured, by name. A context keeps what generators find out about the library."""


def ways() -> Mapping[str, Texts]:
    """The texts of each way. Raises ``MissingPeerError`` if the package is not installed."""
    try:
        library = _Library()
    except ImportError as error:
        raise MissingPeerError(str(error)) from error
    kept = library.contexts()
    return {
        FRESH: lambda number: library.texts(number, library.contexts()),
        KEPT: lambda number: library.texts(number, kept),
    }


class _Library:
    """The parsed library, and the modules of the package. Raises ``ImportError``."""

    def __init__(self) -> None:
        self._core: Any = import_module("MaterialX")
        self._shaders: Any = import_module("MaterialX.PyMaterialXGenShader")
        self._languages: Any = import_module("MaterialX.PyMaterialXGenGlsl")
        self._folders = self._core.getDefaultDataSearchPath()
        self._library = self._core.createDocument()
        names = self._core.getDefaultDataLibraryFolders()
        self._core.loadLibraries(names, self._folders, self._library)

    def contexts(self) -> list[tuple[Any, Any]]:
        """A generator of each language with its context."""
        found = []
        for name in GENERATORS:
            generator = getattr(self._languages, name).create()
            context = self._shaders.GenContext(generator)
            context.registerSourceCodeSearchPath(self._folders)
            found.append((generator, context))
        return found

    def texts(self, number: int, contexts: list[tuple[Any, Any]]) -> Sequence[str]:
        """All texts of a document that sets one input to a value of its own."""
        document = self._core.createDocument()
        document.setDataLibrary(self._library)
        surface = document.addNode("standard_surface", "surface", "surfaceshader")
        surface.setInputValue("base", 0.5 + number / (1 << 20))
        material = document.addMaterialNode("material", surface)
        found: list[str] = []
        for generator, context in contexts:
            shader = generator.generate("shader", material, context)
            found += [shader.getSourceCode(stage) for stage in STAGES]
        return found
