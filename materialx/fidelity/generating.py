"""Generates GLSL by the package MaterialX, and says what the texts read.

Only the worker process imports this module: the package is C++, and a document may come from
anywhere. MaterialX's reduced texts have constants written out, which compile in a fraction of the
time; the complete ones have uniforms for all inputs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from .records import (
    ADDRESS_MODES,
    LIGHT_KINDS,
    MOST_LIGHTS,
    AddressMode,
    FidelityError,
    Generated,
    ImageUse,
    Stream,
    Uniform,
)

WORKING_SPACE = "lin_rec709"
SRGB = ("srgb_texture", "srgb_rec709_scene")
"""The names of the colour space that hosts can decode."""
DISTANCE_UNIT = "meter"

_NUMBERS = frozenset(
    ("float", "integer", "boolean", "vector2", "vector3", "vector4", "color3", "color4",
     "matrix33", "matrix44", "string")
)  # fmt: skip
"""The types of uniforms that hold numbers; texts have a zero where the document has a string."""
_DATA = frozenset(("float", "integer", "boolean", "vector2", "vector3", "vector4"))
"""The types of nodes whose files have numbers and no colours."""
_FILE = "filename"
_LIGHTS = "u_lightData"
"""The array of lights. Texts without lights do not declare it, and yet have a block for it."""
_TWO_SIDED = "u_refractionTwoSided"
"""A uniform that texts of whatever transmits read, and that MaterialX 1.39.5 only declares if there
is an environment. MaterialX's own host sets it to false unless it is asked."""


class Generator:
    """Generates texts of documents, with one parsed library. Raises ``ImportError``."""

    def __init__(self) -> None:
        self._core: Any = import_module("MaterialX")
        self._shaders: Any = import_module("MaterialX.PyMaterialXGenShader")
        self._glsl: Any = import_module("MaterialX.PyMaterialXGenGlsl")
        self._folders = self._core.getDefaultDataSearchPath()
        self._library = self._core.createDocument()
        names = self._core.getDefaultDataLibraryFolders()
        self._core.loadLibraries(names, self._folders, self._library)

    def renderables(self, path: str) -> list[str]:
        """The names of all that a document renders: materials, or else outputs. Raises
        ``FidelityError``."""
        document = self._document(path)
        return list(self._renderables(document))

    def generated(
        self, path: str, renderable: str, lights: Sequence[str], *, complete: bool, by_host: bool
    ) -> Generated:
        """The texts of one renderable, for lights of these kinds.

        With ``by_host``, texts do not decode files from sRGB, and the host has to do it. Raises
        ``FidelityError``.
        """
        document = self._document(path)
        encoded = _without_srgb(document) if by_host else set()
        element = document.getDescendant(renderable)
        if element is None:
            there = ", ".join(self._renderables(document)) or "nothing"
            raise FidelityError(f"there is no `{renderable}` to render; there is {there}")
        # Sampler states stand only in the uniforms of complete texts.
        whole = self._shader(path, element, lights, complete=True)
        taken = whole if complete else self._shader(path, element, lights)
        return _generated(taken, whole, encoded)

    def _renderables(self, document: Any) -> dict[str, Any]:
        """The elements by their names; they live as long as the document."""
        found = self._shaders.findRenderableElements(document)
        return {each.getNamePath(): each for each in found}

    def _document(self, path: str) -> Any:
        document = self._core.createDocument()
        folders = self._core.FileSearchPath(str(Path(path).parent))
        try:
            self._core.readFromXmlFile(document, path, folders)
            document.setDataLibrary(self._library)
        except Exception as error:  # MaterialX's own exceptions have no other base
            raise FidelityError(f"MaterialX cannot read {path}: {error}") from None
        return document

    def _shader(
        self, path: str, element: Any, lights: Sequence[str], *, complete: bool = False
    ) -> Any:
        generator = self._glsl.GlslShaderGenerator.create()
        generator.registerTypeDefs(element.getDocument())
        context = self._context(generator, path, lights, complete=complete)
        try:
            return generator.generate("burnish", element, context)
        except Exception as error:  # MaterialX's own exceptions have no other base
            raise FidelityError(f"MaterialX generates nothing: {error}") from None

    def _context(self, generator: Any, path: str, lights: Sequence[str], *, complete: bool) -> Any:
        """A context of its own for each text: contexts remember what documents define."""
        shaders = self._shaders
        colors = shaders.DefaultColorManagementSystem.create(generator.getTarget())
        colors.loadLibrary(self._library)
        generator.setColorManagementSystem(colors)
        generator.setUnitSystem(self._units(generator))
        context = shaders.GenContext(generator)
        context.registerSourceCodeSearchPath(self._folders)
        context.registerSourceCodeSearchPath(self._core.FileSearchPath(str(Path(path).parent)))
        self._set_options(context.getOptions(), complete=complete)
        for number, kind in enumerate(lights, start=1):
            definition = self._library.getNodeDef(LIGHT_KINDS[kind])
            shaders.HwShaderGenerator.bindLightShader(definition, number, context)
        return context

    def _units(self, generator: Any) -> Any:
        units = self._shaders.UnitSystem.create(generator.getTarget())
        units.loadLibrary(self._library)
        registry = self._core.UnitConverterRegistry.create()
        for kind in self._library.getUnitTypeDefs():
            registry.addUnitConverter(kind, self._core.LinearUnitConverter.create(kind))
        units.setUnitConverterRegistry(registry)
        return units

    def _set_options(self, options: Any, *, complete: bool) -> None:
        shaders = self._shaders
        options.hwSpecularEnvironmentMethod = shaders.SPECULAR_ENVIRONMENT_NONE
        options.hwShadowMap = False
        options.hwTransparency = True
        # Or else weights of mixes go into closures, and into all other uses of these, too.
        options.premultipliedBsdfAdd = False
        options.hwMaxActiveLightSources = MOST_LIGHTS
        options.targetColorSpaceOverride = WORKING_SPACE
        options.targetDistanceUnit = DISTANCE_UNIT
        # Pictures have their first row at the top, and MaterialX's v runs upwards.
        options.fileTextureVerticalFlip = True
        options.shaderInterfaceType = (
            shaders.SHADER_INTERFACE_COMPLETE if complete else shaders.SHADER_INTERFACE_REDUCED
        )


def _without_srgb(document: Any) -> set[str]:
    """Let files in sRGB be linear ones for the generator, and return the paths of their inputs."""
    found = [
        element
        for element in document.traverseTree()
        if element.getAttribute("type") == _FILE
        and element.getActiveColorSpace() in SRGB
        and _has_colors(element)
    ]
    for element in found:
        element.setColorSpace(WORKING_SPACE)
    return {element.getNamePath() for element in found}


def _has_colors(file: Any) -> bool:
    """True if what reads a file gives colours or surfaces; numbers stay as they are in files."""
    owner = file.getParent()
    readers = [owner]
    if owner.getCategory() == "nodegraph":
        ports = [port for node in owner.getNodes() for port in node.getInputs()]
        readers = [
            port.getParent() for port in ports if port.getInterfaceName() == file.getName()
        ] or readers
    return any(reader.getType() not in _DATA for reader in readers)


def _generated(taken: Any, whole: Any, encoded: set[str]) -> Generated:
    vertex, pixel = (taken.getStage(name) for name in ("vertex", "pixel"))
    uniforms: dict[str, Uniform] = {}
    for stage in (vertex, pixel):
        for port in _ports(stage, ("PrivateUniforms", "PublicUniforms")):
            if port.getType().getName() in _NUMBERS:
                uniforms[port.getVariable()] = _uniform(port)
    settings = {
        port.getVariable(): _value(port)
        for port in _ports(whole.getStage("pixel"), ("PublicUniforms",))
    }
    files = (
        port
        for stage in (vertex, pixel)
        for port in _ports(stage, ("PublicUniforms",))
        if port.getType().getName() == _FILE
    )
    images = {port.getVariable(): _image(port, settings, encoded) for port in files}
    text = taken.getSourceCode("pixel")
    lights = _ports(pixel, ("LightData",)) if _LIGHTS in text else ()
    return Generated(
        vertex=taken.getSourceCode("vertex"),
        pixel=_with_two_sided(text),
        streams=tuple(map(_stream, vertex.getInputBlock("VertexInputs"))),
        uniforms=tuple(uniforms.values()),
        images=tuple(images.values()),
        light_members=tuple(map(_stream, lights)),
    )


def _ports(stage: Any, blocks: Sequence[str]) -> Iterator[Any]:
    for name, block in stage.getUniformBlocks().items():
        if name in blocks:
            yield from block


def _stream(port: Any) -> Stream:
    return Stream(port.getVariable(), port.getType().getName())


def _uniform(port: Any) -> Uniform:
    kind = port.getType().getName()
    return Uniform(port.getVariable(), kind, _numbers(_value(port)))


def _value(port: Any) -> Any:
    """The value of a port as one of Python, or of MaterialX's vectors; ``None`` if it has none, or
    is a structure of the document's own."""
    return getattr(port.getValue(), "getData", lambda: None)()


def _numbers(value: Any) -> tuple[float, ...]:
    """A value as numbers; a matrix row by row. Strings are 0 in a text."""
    if value is None:
        return ()
    if isinstance(value, bool | int | float):
        return (float(value),)
    if isinstance(value, str):
        return (0.0,)
    if hasattr(value, "numRows"):
        return tuple(
            float(value[row, column])
            for row in range(value.numRows())
            for column in range(value.numColumns())
        )
    return tuple(float(each) for each in value)


def _image(port: Any, settings: dict[str, Any], encoded: set[str]) -> ImageUse:
    """The state of a sampler, found as MaterialX's renderer finds it: by the names of uniforms."""
    name = port.getVariable()
    root = name.rpartition("_")[0] or name
    value = _value(port)
    default = settings.get(f"{root}_default", settings.get(f"{root}_default_cm_in"))
    return ImageUse(
        name=name,
        file=value if isinstance(value, str) else "",
        wrap_u=_address_mode(settings.get(f"{root}_uaddressmode")),
        wrap_v=_address_mode(settings.get(f"{root}_vaddressmode")),
        nearest=settings.get(f"{root}_filtertype") == 0,
        default=_color(_numbers(default)),
        is_srgb=port.getPath() in encoded,
    )


def _address_mode(value: Any) -> AddressMode:
    """The mode; without one, OpenGL repeats."""
    known = isinstance(value, int) and 0 <= value < len(ADDRESS_MODES)
    return ADDRESS_MODES[value] if known else "periodic"


def _color(lanes: tuple[float, ...]) -> tuple[float, float, float, float]:
    """A default as a colour: a single number is grey, and a missing alpha is 1."""
    match lanes:
        case (grey,):  # the other lanes are not read
            return grey, grey, grey, 1.0
        case (red, green):
            return red, green, 0.0, 1.0
        case (red, green, blue):
            return red, green, blue, 1.0
        case (red, green, blue, alpha):
            return red, green, blue, alpha
    return 0.0, 0.0, 0.0, 1.0


def _with_two_sided(text: str) -> str:
    if _TWO_SIDED not in text or f"uniform bool {_TWO_SIDED}" in text:
        return text
    version, rest = text.split("\n", 1)
    return f"{version}\nconst bool {_TWO_SIDED} = false;\n{rest}"
