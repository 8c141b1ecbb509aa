"""Writes a module of JavaScript with a material of whole shaders, and its types for TypeScript.

The material sets what the renderer knows by itself before each draw, and computes what follows.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ...bindings import registry
from ...bindings.folding import folded
from ...bindings.gathering import Compiled, gathered
from ...bindings.model import Block
from ...bindings.typescript.functions import FUNCTIONS
from ...bindings.writing import deriving, spelling_of
from ...compiler.diagnostics import rules
from ...compiler.diagnostics.diagnostic import Report
from ...compiler.documents.drawing import TextureRow
from ...compiler.documents.reflection import Reflection
from ...support.frozen import frozen
from ..three.sampling import NAMES as SAMPLING
from ..three.sampling import listed, sampling
from ..three.vocabulary import TEXTURE_HELPERS
from . import state
from .derivations import UniformPrinter
from .uniforms import Uniform, number, uniforms_of

_HERE = Path(__file__).parent
TITLE = "three.js's WebGLRenderer"
OF_RENDERER: Mapping[str, tuple[str, bool]] = {
    "eye": ("u.{0}.value.setFromMatrixPosition(camera.matrixWorld);", False),
    "world_to_clip": ("setWorldToClip(u.{0}.value, camera);", False),
    "size": ("u.{0}.value.copy(sizeOf(renderer));", False),
    "object_to_world": ("u.{0}.value = object.matrixWorld;", True),
    "pose": ("setBones(u.{0}.value, object);", True),
}
"""How the renderer's own values are set, by their role; true where each object has its own."""
TEXTURES = {
    "2d": "DataTexture", "2d_array": "DataArrayTexture", "3d": "Data3DTexture",
    "cube": "CubeTexture",
}  # fmt: skip
TEXTURE_TYPES = {**TEXTURES, "2d": "Texture"}
_MAKERS = {"2d": "texel", "2d_array": "layeredTexel", "3d": "volumeTexel", "cube": "cubeTexel"}
_TYPES = re.compile(": (number|boolean)(?=[,) ])")
"""The types in functions of TypeScript, which JavaScript has not."""
_CLASS = re.compile(r"\b[A-Z][A-Za-z0-9]+\b")


def of_renderer(reflection: Reflection) -> Mapping[str, str]:
    """The parameters that the renderer sets, with their roles: those that the library declares.

    A user's own may have a role as well, by its type: it is the user's all the same.
    """
    found = {row.name: row.role or "" for row in reflection.parameters if row.library is not None}
    return {name: role for name, role in found.items() if role in OF_RENDERER}


@frozen
class Texture:
    """A texture of the material."""

    name: str
    begins: str
    type: str
    comment: str
    sampled: str
    """How it is read, as an object of JavaScript; empty if no sampler reads it."""


@frozen
class Function:
    """A function that computes the values of a block, or one that such functions call."""

    name: str
    parameters: str
    comment: str
    lines: tuple[str, ...]


def write(reflection: Reflection, texts: Mapping[str, str], report: Report) -> Mapping[str, str]:
    """The module and its types, by the names of their files; none if something is reported."""
    reasons = [*state.lacking(reflection), *_lacking_textures(reflection)]
    if reasons:
        name = reflection.material
        report.add(rules.UNFIT_FOR_ENGINE, None, slot=name, engine=TITLE, reason=reasons[0])
        return {}
    written = _Writer(reflection, texts).all()
    name = f"{reflection.material}.three-webgl"
    return {
        f"{name}.js": _filled("module.js.j2", written),
        f"{name}.d.ts": _filled("module.d.ts.j2", written),
    }


def _filled(template: str, written: Mapping[str, Any]) -> str:
    from jinja2 import Environment, StrictUndefined

    environment = Environment(
        autoescape=False, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
    text = environment.from_string((_HERE / template).read_text(encoding="utf-8")).render(written)
    return text if template.endswith(".js.j2") else folded(text, registry.load("typescript").style)


def _lacking_textures(reflection: Reflection) -> Iterator[str]:
    for row in reflection.textures:
        if row.dimension not in TEXTURES:
            yield f"it has no {row.type}, as `{row.name}` is"
    for sampler in reflection.samplers:
        if sampler.state.border is not None:
            yield f"it has no borders of textures, as `{sampler.texture}` wants"


class _Writer:
    def __init__(self, reflection: Reflection, texts: Mapping[str, str]) -> None:
        self._reflection, self._texts = reflection, texts
        self._of_renderer = of_renderer(reflection)
        (self._backend,) = reflection.backends.values()
        self._binding = gathered([Compiled(reflection=reflection, texts={})], [], (), "")
        (material,) = self._binding.materials
        self._blocks = material.blocks
        self._uniforms = tuple(uniforms_of(material, self._backend))
        self._printer = UniformPrinter(self._uniforms)
        self._printer.spelling = spelling_of(self._binding, registry.load("typescript"))

    def all(self) -> Mapping[str, Any]:
        """What the templates read."""
        reflection = self._reflection
        textures = tuple(self._textures())
        functions = [*self._helpers(), *self._derivations()]
        properties = state.state_of(reflection)
        each_frame = [*self._set_by_renderer(per_object=False), *self._calls(per_object=False)]
        each_draw = [*self._set_by_renderer(per_object=True), *self._calls(per_object=True)]
        used = [
            "Matrix4" if any("setBones" in line for line in each_draw) else "",
            *(each.begins for each in self._uniforms),
            *(each.begins for each in textures), *properties.values(),
            *(each.sampled for each in textures),
        ]  # fmt: skip
        settable = [each for each in self._uniforms if self._is_settable(each)]
        types = [*(each.type for each in settable), *(each.type for each in textures)]
        makers = _makers(textures)
        encodes = "encodes_color" in self._texts["fragment"]
        height = next(iter(self._backend.host_uniforms), "")
        sizes = bool(height) or any("sizeOf" in line for line in each_frame)
        return {
            "name": reflection.material,
            "doc": reflection.doc.splitlines(),
            "vertex": _quoted(self._texts["vertex"]),
            "fragment": _quoted(self._texts["fragment"]),
            "inputs": [
                (self._backend.vertex_inputs[row.name].identifier, row.representation)
                for row in reflection.vertex_inputs
            ],
            "uniforms": self._uniforms,
            "settable": settable,
            "textures": textures,
            "counted": list(self._counted(settable)),
            "functions": functions,
            "convenience": [_TYPES.sub("", FUNCTIONS[name]) for name in sorted(self._printer.used)],
            "makers": makers,
            "state": properties,
            "each_frame": each_frame,
            "each_draw": each_draw,
            "words": "\n".join((*each_frame, *each_draw)),
            "encodes": encodes,
            "height": height,
            "classes": sorted(_classes(used, sizes, encodes, makers)),
            "types": sorted({word for text in types for word in _CLASS.findall(text)} & CLASSES),
        }  # fmt: skip

    # --- uniforms --------------------------------------------------------------------------------

    def _is_settable(self, each: Uniform) -> bool:
        return not each.field.computed and each.field.name not in self._of_renderer

    def _counted(self, settable: Iterable[Uniform]) -> Iterator[tuple[str, str]]:
        """Arrays, each with the name of its counter, which is empty where all elements count."""
        names = {(each.block.plain_name, each.field.word): each.name for each in self._uniforms}
        for each in settable:
            if each.field.capacity:
                counter = each.field.counter
                yield each.name, names[each.block.plain_name, counter] if counter else ""

    def _textures(self) -> Iterator[Texture]:
        samplers = {row.texture: row.state for row in self._reflection.samplers}
        for row in self._reflection.textures:
            if row.name in self._backend.textures:
                sampler = samplers.get(row.name)
                properties = {} if sampler is None else sampling(sampler, row.dimension)
                name = self._backend.textures[row.name].identifier
                yield Texture(
                    name, _texel(row, name) if properties else _texel(row),
                    "DepthTexture" if row.sample == "depth" else TEXTURE_TYPES[row.dimension],
                    _about(row), listed(properties) if properties else "",
                )  # fmt: skip

    # --- what is set before a draw ---------------------------------------------------------------

    def _set_by_renderer(self, *, per_object: bool) -> Iterator[str]:
        for each in self._uniforms:
            role = self._of_renderer.get(each.field.name)
            if role is not None and not each.field.computed:
                form, is_of_object = OF_RENDERER[role]
                if is_of_object == per_object:
                    yield form.format(each.name)

    def _calls(self, *, per_object: bool) -> Iterator[str]:
        for block in self._blocks:
            if block.derivation is not None and (block.group == "draw") == per_object:
                yield f"{self._function(block)}(u);"

    def _function(self, block: Block) -> str:
        return self._printer.spelling.function(deriving(block))

    def _derivations(self) -> Iterator[Function]:
        for block in self._blocks:
            if block.derivation is not None:
                self._printer.block = block.plain_name
                sources = " and ".join(source.plain_name for source in block.sources)
                yield Function(
                    self._function(block), "u", f"What follows from {sources}.",
                    tuple(self._printer.statements(block.derivation.statements, "  ")),
                )  # fmt: skip

    def _helpers(self) -> Iterator[Function]:
        spelling = self._printer.spelling
        for each in self._binding.helpers:
            yield Function(
                spelling.function(each.name), ", ".join(map(spelling.local, each.parameters)), "",
                tuple(self._printer.statements(each.statements, "  ")),
            )  # fmt: skip


def _classes(
    used: Iterable[str], sizes: bool, encodes: bool, makers: Mapping[str, str]
) -> set[str]:
    """The names that a module imports from three.js, besides those that all import."""
    found = {word for text in used for word in _CLASS.findall(text)} & CLASSES
    found |= {"Vector2"} if sizes else set()
    found |= {"SRGBColorSpace"} if encodes else set()
    return found | ({"DataUtils", "HalfFloatType", *makers} if makers else set())


CLASSES = frozenset((
    *state.SIDES.values(), *state.DEPTHS.values(), *state.FACTORS.values(),
    *state.OPERATIONS.values(), *SAMPLING, *TEXTURE_TYPES.values(), *TEXTURES.values(),
    "DepthTexture", "CustomBlending", "NoBlending", "Color", "Vector2", "Vector3", "Vector4",
    "Matrix2", "Matrix3", "Matrix4",
))  # fmt: skip
"""The names that modules import from three.js as they need them."""


def _texel(row: TextureRow, sampled: str = "") -> str:
    """The default of a texture, in JavaScript; with the properties by which it is read."""
    if row.sample != "float":
        return "null"
    text = f"{_MAKERS[row.dimension]}({', '.join(map(number, row.default_texel))})"
    return f"Object.assign({text}, sampling.{sampled})" if sampled else text


def _makers(textures: Iterable[Texture]) -> Mapping[str, str]:
    """The functions that make default textures, by the class of what each makes."""
    words = {word for each in textures for word in re.findall(r"\w+", each.begins)}
    if "cubeTexel" in words:
        words.add("texel")
    return {
        TEXTURES[dimension]: TEXTURE_HELPERS[name]
        for dimension, name in _MAKERS.items() if name in words
    }  # fmt: skip


def _about(row: TextureRow) -> str:
    space = "its colours are decoded: give it `SRGBColorSpace`" if row.intent == "color" else ""
    return "; ".join(filter(None, (" ".join(row.doc.split()), space))).replace("*/", "* /")


def _quoted(text: str) -> str:
    """A text between backquotes."""
    return text.replace("\\", "\\\\").replace("`", "\\`").replace("${", "\\${")
