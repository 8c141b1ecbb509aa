"""Writes a module of JavaScript with a material for three.js, and its types for TypeScript.

The material extends the node material that fits its slots. Each slot is the call of a function, in
WGSL for WebGPU and in GLSL for WebGL 2; parameters are uniforms, and everything else is what the
renderer has (``inputs.py``). Which node a slot becomes says the table in ``slots.py``.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from ...compiler.diagnostics.diagnostic import Report
from ...compiler.documents.functions import (
    ArgumentRow,
    FunctionRow,
    Functions,
    FunctionTextRow,
)
from ...support.frozen import cached_property, frozen
from ...targets.emit.functions import FunctionEmission
from .. import slot_table
from ..drawing import adds, covers, culled, multiplies
from . import inputs
from .lacking import fits
from .sampling import listed, sampling
from .slots import VERTICES, rows_for
from .vocabulary import CLASSES, TEXTURE_HELPERS, WORDS

WGSL, GLSL = "wgsl:webgpu", "glsl:es300"
"""The profiles of the functions: WebGPU's language, and WebGL 2's."""
SIDES = {"none": "DoubleSide", "back": "FrontSide", "front": "BackSide"}
"""The sides that are drawn, by the faces that are not."""
COLOR_FORMS = {"float": "vec3({0})", "vec3": "{0}", "vec4": "{0}.rgb"}
"""A colour as nodes take it, by the type of the slot."""
LANGUAGES = {"wgsl": WGSL, "glsl": GLSL}
_HERE = Path(__file__).parent
_SHARED = ("surface", "attribute")
"""The sources of arguments that are the same nodes for all functions."""


@frozen
class Entry:
    """A name with code, as templates print it."""

    name: str
    code: str = ""
    type: str = ""
    comment: str = ""
    variable: str = ""


@frozen
class Part:
    """A part of the texts in both languages."""

    name: str
    texts: tuple[tuple[str, str], ...]
    needs: tuple[tuple[str, tuple[str, ...]], ...] = ()


@frozen
class Module:
    """Everything that the templates print."""

    name: str
    maker: str
    doc: tuple[str, ...]
    base: str
    classes: tuple[str, ...]
    type_classes: tuple[str, ...]
    words: tuple[str, ...]
    texture_helpers: tuple[str, ...]
    has_switches: bool
    helpers: tuple[Part, ...]
    functions: tuple[Part, ...]
    uniforms: tuple[Entry, ...]
    textures: tuple[Entry, ...]
    sampling: tuple[Entry, ...]
    settable: tuple[Entry, ...]
    calls: tuple[Entry, ...]
    placed: tuple[str, ...]
    """What is kept of a vertex before the material moves it."""
    slots: tuple[Entry, ...]
    nodes: tuple[Entry, ...]
    settings: tuple[Entry, ...]


def write(
    document: Functions, emissions: Mapping[str, FunctionEmission], report: Report
) -> Mapping[str, str]:
    """The module and its types, by the names of their files; none if something is reported."""
    if not fits(document, report):
        return {}
    module = _Writer(document, emissions).module()
    name = f"{document.material}.three"
    return {
        f"{name}.js": _filled("module.js.j2", module),
        f"{name}.d.ts": _filled("module.d.ts.j2", module),
    }


def _filled(template: str, module: Module) -> str:
    from jinja2 import Environment, StrictUndefined

    environment = Environment(
        autoescape=False, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
    text = (_HERE / template).read_text(encoding="utf-8")
    return environment.from_string(text).render(module=module)


# --- the module ----------------------------------------------------------------------------------


class _Writer:
    def __init__(self, document: Functions, emissions: Mapping[str, FunctionEmission]) -> None:
        self._document, self._emissions = document, emissions
        self._arguments = {row.name: row for row in document.arguments}
        self._functions = {row.name: row for row in document.functions}
        given = slot_table.found(document)
        self._words = {word: row.slots[0].name for word, row in given.items()}
        self._texts = {
            name: {
                language: document.backends[profile].functions[name]
                for language, profile in LANGUAGES.items()
            }
            for name in self._functions
        }

    def module(self) -> Module:
        """The whole module."""
        document = self._document
        uniforms, textures = tuple(self._uniforms()), tuple(self._textures())
        sampled = tuple(self._sampling())
        helpers, functions = tuple(self._helpers()), tuple(map(self._function, document.functions))
        nodes = tuple(self._nodes())
        calls = tuple(self._calls())
        settings = tuple(self._settings(nodes))
        moves = any(node.name == "positionNode" for node in nodes)
        base = self._base(nodes)
        code = "\n".join(each.code for each in (*uniforms, *textures, *calls, *nodes, *settings))
        words = set(re.findall(r"(?<![\w.])[A-Za-z]\w*", code))
        texts = [text for name, text in TEXTURE_HELPERS.items() if name in words]
        used = words | set(re.findall(r"[A-Za-z]\w*", "\n".join(texts)))
        own = {base, "CodeNode", "FunctionNode", *(("Node",) if textures else ())}
        own |= {"DataUtils", "HalfFloatType", "LinearFilter"} if textures else set()
        switches = "switched" in words
        words |= {"uniform", "uint"} if switches else set()
        own |= {word for each in sampled for word in re.findall(r"\b[A-Z]\w+", each.code)}
        types = {each.type for each in (*uniforms, *textures)} | {base, "Node"}
        return Module(
            name=document.material,
            maker=f"make{document.material}",
            doc=tuple(document.doc.splitlines()),
            base=base,
            classes=tuple(name for name in CLASSES if name in used | own),
            type_classes=tuple(name for name in (*CLASSES, "Texture") if name in types),
            words=tuple(name for name in WORDS if name in words),
            texture_helpers=tuple(texts),
            has_switches=switches,
            helpers=helpers,
            functions=functions,
            uniforms=uniforms,
            textures=textures,
            sampling=sampled,
            settable=(*uniforms, *textures),
            calls=calls,
            placed=tuple(map(_placed_name, self._placed)) if moves else (),
            slots=tuple(self._slots()),
            nodes=nodes,
            settings=settings,
        )

    def _settings(self, nodes: Sequence[Entry]) -> Iterator[Entry]:
        """How the material is drawn: blended or not, and which of its sides."""
        document = self._document
        has_alpha = any(node.name == "opacityNode" for node in nodes)
        if has_alpha and covers(document):
            yield Entry("alphaToCoverage", "true")
        elif has_alpha or adds(document) or multiplies(document):
            yield Entry("transparent", "true")
        if adds(document):
            yield Entry("blending", "AdditiveBlending")
        if multiplies(document):
            yield Entry("blending", "MultiplyBlending")
            yield Entry("premultipliedAlpha", "true")
        cull = culled(document)
        if cull is not None:
            yield Entry("side", SIDES[cull])

    def _base(self, nodes: Sequence[Entry]) -> str:
        named = {node.name for node in nodes}
        others = named - {"colorNode", "opacityNode", "maskNode", "positionNode"}
        is_basic = not slot_table.is_lit(self._words) and not others
        return "MeshBasicNodeMaterial" if is_basic else "MeshPhysicalNodeMaterial"

    # --- code ------------------------------------------------------------------------------------

    def _helpers(self) -> Iterator[Part]:
        """Structures and functions of both texts; one that a language lacks is empty there."""
        found: dict[str, dict[str, str]] = {}
        for language, profile in LANGUAGES.items():
            for part in self._emissions[profile].helpers:
                found.setdefault(part.name, {})[language] = part.text
        for name, texts in found.items():
            yield Part(name, tuple((each, _quoted(texts.get(each, ""))) for each in LANGUAGES))

    def _function(self, row: FunctionRow) -> Part:
        emitted = {
            language: next(
                each.part for each in self._emissions[profile].functions if each.name == row.name
            )
            for language, profile in LANGUAGES.items()
        }
        return Part(
            _constant(row.name),
            tuple((language, _quoted(part.text)) for language, part in emitted.items()),
            tuple((language, part.needs) for language, part in emitted.items()),
        )

    # --- values ----------------------------------------------------------------------------------

    def _uniforms(self) -> Iterator[Entry]:
        for row in self._document.arguments:
            if row.source == "parameter" and not inputs.of_renderer(row):
                type_ = inputs.uniform_type(row)
                code = inputs.VALUES[type_].format(", ".join(_numbers(row, type_)))
                comment = _comment(row.doc, row.range)
                numbers = inputs.TYPES[type_]
                if row.choices is not None:
                    names = [f"{number} {each.name}" for number, each in enumerate(row.choices)]
                    comment = f"{_comment(row.doc, None)} ({', '.join(names)})".lstrip()
                    numbers = " | ".join(str(number) for number in range(len(names)))
                yield Entry(row.name, code, numbers, comment)

    def _sampling(self) -> Iterator[Entry]:
        """How each texture is read. One without any linear filter and levels has no sampler."""
        for row in self._document.textures:
            if row.state is not None:
                found = dict(sampling(row.state, row.dimension))
                if {found["magFilter"], found["minFilter"]} == {"NearestFilter"}:
                    found["minFilter"] = "NearestMipmapNearestFilter"
                yield Entry(row.name, listed(found))

    def _textures(self) -> Iterator[Entry]:
        for row in self._document.textures:
            code = inputs.TEXTURES[row.type].format(", ".join(map(_number, row.default_texel)))
            space = (
                "(Its colours are decoded: give it `SRGBColorSpace`.)"
                if row.intent == "color"
                else ""
            )
            comment = " ".join(filter(None, (_comment(row.doc, None), space)))
            yield Entry(row.name, code, inputs.TEXTURE_TYPES[row.type], comment)

    # --- calls -----------------------------------------------------------------------------------

    def _calls(self) -> Iterator[Entry]:
        """What functions share of the surface, so that it is interpolated once, and their calls.

        Those for vertices, which others interpolate, come first.
        """
        shared = [row for row in self._document.arguments if self._is_shared(row)]
        interpolated = [row for row in self._document.arguments if row.source == "varying"]
        names = {row.given for row in interpolated}
        rows = sorted(self._document.functions, key=lambda row: row.name not in names)
        for argument in shared:
            yield Entry("", _shared_value(argument), variable=_given_name(argument))
        for argument in self._placed:
            code = f"{inputs.AS_PLACED[argument.given]}.toVar()"
            yield Entry("", code, variable=_placed_name(argument))
        for row in rows[: len(names)]:
            yield Entry("", self._call(row), variable=_variable(row.name))
        for argument in interpolated:
            flat = '.setInterpolation("flat")' if argument.interpolation == "flat" else ""
            code = f"varying({_variable(argument.given)}){flat}"
            yield Entry("", code, variable=_given_name(argument))
        for row in rows[len(names) :]:
            yield Entry("", self._call(row), variable=_variable(row.name))

    def _readers(self, row: ArgumentRow, stage: str) -> bool:
        """True if a function of a stage has an argument."""
        functions = self._document.functions
        return any(each.stage == stage and row.name in each.arguments for each in functions)

    def _is_shared(self, row: ArgumentRow) -> bool:
        """True for a value that is the same node for all functions that have it."""
        is_read = row.given not in inputs.AS_PLACED or self._readers(row, "fragment")
        return row.source in _SHARED and is_read

    @cached_property
    def _placed(self) -> Sequence[ArgumentRow]:
        """What functions for vertices read of a vertex as three.js has placed it.

        It has to be kept before the material moves the vertex.
        """
        rows = (row for row in self._document.arguments if row.source == "attribute")
        return [
            row for row in rows if row.given in inputs.AS_PLACED and self._readers(row, "vertex")
        ]

    def _call(self, row: FunctionRow) -> str:
        given: dict[str, str] = {}
        for text in self._texts[row.name].values():
            given |= dict(self._given(row, text))
        listed = ", ".join(f"{name}: {code}" for name, code in given.items())
        return (
            f"{_constant(row.name)}.call({{ {listed} }})"
            if given
            else f"{_constant(row.name)}.call()"
        )

    def _given(self, row: FunctionRow, text: FunctionTextRow) -> Iterator[tuple[str, str]]:
        for each in text.arguments:
            if each.kind == "value":
                yield each.identifier, self._value(self._arguments[each.given], row)
            elif each.kind == "texture":
                yield each.identifier, f"new Argument(textures.{each.given})"
            else:
                yield each.identifier, f"sampler(textures.{each.given})"

    def _value(self, row: ArgumentRow, function: FunctionRow) -> str:
        if function.stage == "vertex" and row in self._placed:
            return _placed_name(row)
        if row.source in (*_SHARED, "varying"):
            return _given_name(row)
        if row.source == "pipeline":
            return inputs.PIPELINE[row.given]
        if inputs.of_renderer(row):
            return inputs.ROLES[row.role or ""]
        read = f"parameters.{row.name}"
        return f"{read}.node" if row.representation == "bool" else read

    # --- nodes -----------------------------------------------------------------------------------

    def _slots(self) -> Iterator[Entry]:
        for row in self._document.functions:
            for slot in row.slots:
                yield Entry(
                    slot.name, type=f'Node<"{slot.representation}">',
                    comment=_comment(slot.doc, None), variable=_variable(row.name),
                )  # fmt: skip

    def _nodes(self) -> Iterator[Entry]:
        for row in rows_for(self._words):
            others = {word: f"slots.{self._words[word]}" for word in row.needs}
            form = row.form
            if form == "{0}.rgb":
                form = COLOR_FORMS[self._type(row.word)]
            yield Entry(row.node, form.format(f"slots.{self._words[row.word]}", **others))
        yield from self._placing()

    def _type(self, word: str) -> str:
        name = self._words[word]
        (slot,) = (s for row in self._document.functions for s in row.slots if s.name == name)
        return slot.representation

    def _placing(self) -> Iterator[Entry]:
        position, normal, moved = (self._words.get(word) for word in VERTICES)
        placed = "positionLocal" if position is None else f"slots.{position}"
        if moved is not None:  # A place in the world, as the material itself has it.
            position = moved
            placed = f"modelWorldMatrixInverse.mul(vec4(slots.{moved}, 1)).xyz"
        lines = ["placed.forEach((node) => node.toStack());"] if self._placed else []
        if normal is not None:  # The place may be computed from the normal that the mesh has.
            lines += [f"const place = {placed}.toVar();", f"normalLocal.assign(slots.{normal});"]
            placed = "place"
        if position is not None or normal is not None:
            yield Entry("positionNode", _function(lines, placed) if lines else placed)


def _function(lines: Sequence[str], result: str) -> str:
    """A function of three.js that runs some statements before it gives a result."""
    inner = "".join(f"\n      {line}" for line in (*lines, f"return {result};"))
    return f"Fn(() => {{{inner}\n    }})()"


def _placed_name(row: ArgumentRow) -> str:
    """The variable for a value of a vertex as three.js has placed it."""
    return f"placed_{row.name}"


def _given_name(row: ArgumentRow) -> str:
    """The variable for an argument that several functions share."""
    return f"given_{row.name}"


def _shared_value(row: ArgumentRow) -> str:
    """A value of the surface, or a vertex input."""
    if row.source == "surface":
        return inputs.SURFACE[row.given]
    name = inputs.attribute_name(row.given)
    return f'attribute("{name}", "{row.representation}")'


def _constant(name: str) -> str:
    """The name of the node of a function, beside names of parts of the texts."""
    return f"call_{name}"


def _variable(name: str) -> str:
    return f"slot_{name}"


def _numbers(row: ArgumentRow, type_: str) -> Iterable[str]:
    """The numbers of a parameter's default; without one, zeros, or a matrix that moves nothing."""
    if row.default is not None:
        return list(map(_number, _flat(row.default)))
    if type_ in ("mat3", "mat4"):
        size = int(type_[3])
        return [_number(float(row == column)) for row in range(size) for column in range(size)]
    count = 3 if type_ == "rgb" else int(type_[-1]) if type_[-1].isdigit() else 1
    return ["0"] * count


def _flat(value: object) -> Iterator[float]:
    if isinstance(value, Sequence) and not isinstance(value, str):
        for each in value:
            yield from _flat(each)
    else:
        assert isinstance(value, int | float)
        yield value


def _number(value: float) -> str:
    return json.dumps(value) if isinstance(value, bool) else repr(float(value)).removesuffix(".0")


def _comment(doc: str, range_: tuple[float, float] | None) -> str:
    """A doc comment on one line, with the range of a parameter."""
    text = " ".join(doc.split()).replace("*/", "* /")
    return " ".join(
        filter(None, (text, range_ and f"({_number(range_[0])} to {_number(range_[1])})"))
    )


def _quoted(text: str) -> str:
    """A text between backquotes."""
    return text.replace("\\", "\\\\").replace("`", "\\`").replace("${", "\\${")
