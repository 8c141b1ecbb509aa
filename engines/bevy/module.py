"""The module of a material: Rust that gives Bevy its shader, its parameters and its textures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...support.frozen import frozen
from ..drawing import adds, covers, culled, multiplies
from ..surface import Surface, UnfitError
from .fields import TYPES, Choice, Field, choice, identifier, parameter
from .images import Loading, Texel, field, loading, texel
from .shader import bindings, structure
from .statements import Statements
from .texts import filled
from .values import ATTRIBUTES

PREPASS_LOCATIONS = {"normal": 3, "tangent": 4}
"""The locations of vertex inputs, where pixels are drawn before they are lit."""
SIDES: Mapping[str | None, tuple[str, ...]] = {
    "none": ("cull_mode: None", "double_sided: true"),
    "back": ("cull_mode: Some(Face::Back)",),
    "front": ("cull_mode: Some(Face::Front)",),
}
"""Settings for the faces that are not drawn."""
MARKS = {"clearcoat": "clearcoat: 1.0", "transmission": "specular_transmission: 1.0"}
"""Settings without which Bevy leaves the code of a slot out, by the slots."""
TAKEN = frozenset({
    "App", "AsBindGroup", "AsBindGroupError", "Asset", "Assets", "Clone", "Debug", "Default",
    "ExtendedMaterial", "Extent3d", "From", "Handle", "Image", "ImageAddressMode",
    "ImageFilterMode", "ImageLoaderSettings", "ImageSampler", "ImageSamplerBorderColor",
    "ImageSamplerDescriptor", "LinearRgba", "MaterialExtension", "MaterialExtensionKey",
    "MaterialExtensionPipeline", "MaterialPlugin", "Mesh", "MeshVertexBufferLayoutRef", "Ok",
    "Plugin", "Reflect", "RenderAssetUsages", "RenderPipelineDescriptor", "Result", "Self",
    "Shader", "ShaderDefVal", "ShaderRef", "ShaderType", "Some", "SpecializedMeshPipelineError",
    "StandardMaterial", "TextureDimension", "TextureFormat", "TextureViewDescriptor",
    "TextureViewDimension", "AlphaMode", "Vec",
})  # fmt: skip
"""Names of Rust and of Bevy that modules use, so that no material can have them there."""
IDENTITY = "https://burnish.invalid/bevy/"
"""The beginning of what the identities of assets are made of."""


@frozen
class Named:
    """A texture that stands in, with its identity."""

    texel: Texel
    uuid: str


@frozen
class Deep:
    """A vertex input that Bevy leaves out where it draws only depths."""

    definition: str
    attribute: str
    location: int


@frozen(kw_only=True)
class Module:
    """Everything that the template prints."""

    name: str
    doc: tuple[str, ...]
    file: str
    uuid: str
    structure: str
    fields: tuple[Field, ...]
    parameters: tuple[Field, ...]
    choices: tuple[Choice, ...]
    textures: tuple[Loading, ...]
    texels: tuple[Named, ...]
    image_words: tuple[str, ...]
    settings: tuple[str, ...]
    shaders: tuple[str, ...]
    attributes: tuple[str, ...]
    deep: tuple[Deep, ...]


def module_text(surface: Surface, statements: Statements, shader: str, file: str) -> str:
    """The text of the module. Raises ``UnfitError``."""
    if surface.name in TAKEN or surface.name in TYPES.values():
        raise UnfitError(surface.name, "modules use something of Bevy or Rust that is called so")
    return filled("material.rs.j2", material=_module(surface, statements, shader, file))


def _module(surface: Surface, statements: Statements, shader: str, file: str) -> Module:
    rows = statements.parameters
    parameters = tuple(parameter(surface.name, row) for row in rows.values())
    textures = tuple(loading(row) for row in statements.textures.values())
    texels = dict.fromkeys(map(texel, statements.textures.values()))
    attributes = statements.attributes
    return Module(
        name=surface.name,
        doc=tuple(surface.document.doc.splitlines()),
        file=file,
        uuid=_identity(shader),
        structure=structure(surface),
        fields=(*parameters, *_textures(surface, statements)),
        parameters=parameters,
        choices=tuple(filter(None, (choice(surface.name, row) for row in rows.values()))),
        textures=textures,
        texels=tuple(Named(each, _identity(f"{each.constant} {each.lanes}")) for each in texels),
        image_words=tuple(_image_words(textures)),
        settings=tuple(_settings(surface, statements)),
        shaders=tuple(_shaders(statements)),
        attributes=tuple(ATTRIBUTES[name] for name in attributes),
        deep=tuple(
            Deep(f"VERTEX_{name.upper()}S", ATTRIBUTES[name], PREPASS_LOCATIONS[name])
            for name in statements.needs_deep
        ),
    )


def _textures(surface: Surface, statements: Statements) -> Iterator[Field]:
    rows = bindings(surface, statements)
    numbers = {row.name: row.number for row in rows}
    samplers = {row.number for row in rows if row.type == "sampler"}
    for name, row in statements.textures.items():
        yield field(row, numbers[name], numbers[name] + 1 in samplers)


def _image_words(textures: tuple[Loading, ...]) -> Iterator[str]:
    """What the module imports of Bevy's images."""
    text = " ".join(setting for each in textures for setting in each.sampler)
    for word in ("ImageAddressMode", "ImageFilterMode"):
        if f"{word}::" in text:
            yield word
    yield "ImageLoaderSettings"
    if text:
        yield from ("ImageSampler", "ImageSamplerDescriptor")
    if "ImageSamplerBorderColor::" in text:
        yield "ImageSamplerBorderColor"


def _settings(surface: Surface, statements: Statements) -> Iterator[str]:
    """The settings of Bevy's own material without which slots have no effect."""
    if not surface.is_lit:
        yield "unlit: true"
    alpha = _alpha_mode(surface, statements)
    if alpha is not None:
        yield f"alpha_mode: {alpha}"
    yield from SIDES.get(culled(surface.document), ())
    for name, setting in MARKS.items():
        if name in surface.inputs:
            yield setting


def _alpha_mode(surface: Surface, statements: Statements) -> str | None:
    """How pixels are blended; only those of a mask may be absent where depths are drawn."""
    opaque = "AlphaMode::Mask(0.5)" if "is_hidden" in surface.inputs else "AlphaMode::Opaque"
    if adds(surface.document):
        return "AlphaMode::Add"
    if multiplies(surface.document):
        return "AlphaMode::Multiply"
    if "alpha" in surface.inputs and covers(surface.document):
        return "AlphaMode::AlphaToCoverage"
    if "alpha" in surface.inputs:
        for row in statements.parameters.values():
            if row.role == "is_opaque":
                name = identifier(row.name)
                return f"if self.{name} {{ {opaque} }} else {{ AlphaMode::Blend }}"
        return "AlphaMode::Blend"
    return opaque if "is_hidden" in surface.inputs else None


def _shaders(statements: Statements) -> Iterator[str]:
    """The stages that have a shader of the material's own."""
    if statements.has_vertices:
        yield from ("vertex", "prepass_vertex", "deferred_vertex")
    yield from ("fragment", "deferred_fragment")
    if statements.has_prepass:
        yield "prepass_fragment"


def _identity(text: str) -> str:
    """The identity of an asset: that of its text."""
    import uuid

    return str(uuid.uuid5(uuid.NAMESPACE_URL, IDENTITY + text))
