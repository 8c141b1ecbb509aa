"""Rows of the tables of materials, as C and C++ initialise them.

The words in them are enumerators of the host, which ``words`` declares.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ...compiler.documents.writing import to_json
from ..folding import WIDTH
from ..model import Bound, Material, Text
from ..naming import in_ascii, snake, words
from .lines import real, string
from .words import words_of

_STAGES = {"vertex": 1, "fragment": 2, "compute": 4, "geometry": 8, "control": 16, "evaluation": 32}
_MASK = {"r": 1, "g": 2, "b": 4, "a": 8}


class Tables:
    """Spells rows."""

    def __init__(
        self,
        enumerator: Callable[[str, str], str],
        type_name: Callable[[str], str],
        literal: Callable[[str | None], str],
        nothing: str,
    ) -> None:
        """``enumerator`` spells a word of an enumeration, and ``type_name`` the type of a block.

        ``literal`` spells an embedded text, or that there is none, and ``nothing`` is a structure
        of zeros, where there is no sampler, blending or stencil test.
        """
        self._enumerator, self._type_name, self._literal = enumerator, type_name, literal
        self._nothing = nothing

    def word(self, enumeration: str, word: str) -> str:
        """A word of an enumeration."""
        assert word in words_of(enumeration).constants, (enumeration, word)
        return self._enumerator(enumeration, word)

    def bound(self, row: Bound) -> str:
        """A row of the table of bindings."""
        size = f"sizeof({self._type_name(row.name)})" if row.is_block else "0"
        stages = sum(_STAGES.get(stage, 0) for stage in row.stages)
        return _row(
            string(row.name), self.word("Kind", row.kind), _or_none(row.group),
            _or_none(row.binding), stages, size, string(row.identifier), str(row.is_read).lower(),
        )  # fmt: skip

    def text(self, embedded: Callable[[str], str], row: Text) -> str:
        """A row of the table of texts."""
        text = self._literal(row.text)
        text = text if row.text is None else embedded(text)
        names = (row.stage, row.file, row.entry_point, row.module)
        return _row(*map(string, names), text)

    def textures(self, material: Material) -> list[str]:
        """The rows of the table of textures."""
        states = {each.texture: each.state for each in material.reflection.samplers}
        return [
            self._texture(row, to_json(states[row.name]) if row.name in states else None)
            for row in material.reflection.textures
        ]

    def _texture(self, row: Any, state: Mapping[str, Any] | None) -> str:
        layout = to_json(row.layout)
        texel = ", ".join(real(lane) for lane in row.default_texel)
        return _row(
            string(row.name), self.word("Dimension", layout["viewDimension"]),
            self.word("SampleType", layout["sampleType"]), self.word("Intent", row.intent),
            f"{{{texel}}}", self.word("SamplerType", layout["sampler"] or "none"),
            self._sampler(state) if state else self._nothing,
        )  # fmt: skip

    def _sampler(self, state: Mapping[str, Any]) -> str:
        wraps = (state.get(f"wrap_{axis}", state["wrap"]) for axis in "uvw")
        compare = state.get("compare")
        return _row(
            self.word("Filter", state["filter"]), self.word("Mip", state["mip"]),
            *(self.word("Wrap", each) for each in wraps),
            self.word("Border", state.get("border") or "transparent"),
            _truth(compare is not None), self.word("Compare", compare or "always"),
            state.get("anisotropy") or 1,
        )  # fmt: skip

    def input(self, row: Any) -> str:
        """A row of the table of vertex inputs."""
        return _row(
            string(row.name), _or_none(row.location),
            self.word("VertexFormat", row.format or "none"), _truth(row.step == "instance"),
        )  # fmt: skip

    def target(self, row: Any) -> str:
        """A row of the table of targets."""
        found = to_json(row)
        mask = sum(_MASK.get(lane, 0) for lane in row.mask) if row.mask != "none" else 0
        blend = found["blend"]
        return _row(
            string(row.name), row.location, self.word("Format", found["format"]),
            self.word("Encoding", row.encoding), mask,
            self._blend(blend) if blend else self._nothing,
        )  # fmt: skip

    def _blend(self, blend: Mapping[str, Any]) -> str:
        return _row("true", *(self._equation(blend[each]) for each in ("color", "alpha")))

    def _equation(self, side: Mapping[str, str]) -> str:
        return _row(
            self.word("Factor", side["source"]), self.word("Factor", side["destination"]),
            self.word("Operation", side["operation"]),
        )  # fmt: skip

    def states(self, material: Material) -> list[str]:
        """The state of the pipeline: the draw, the depth test, the stencil test."""
        state = to_json(material.reflection.render_state)
        draw = to_json(material.reflection.draw)
        depth = state["depth"]
        first = (
            self.word("Topology", draw["topology"]), self.word("Cull", state["cull"]),
            self.word("Fill", state["fill"]), state["samples"],
            _truth(state["alpha_to_coverage"]),
        )  # fmt: skip
        tested = _row(
            self.word("Compare", depth["compare"]), _truth(depth["write"]), depth["bias"],
            real(depth["slope_bias"]), real(depth["bias_clamp"]),
        )  # fmt: skip
        stencil = state["stencil"]
        masked = self._stencil(stencil) if stencil else self._nothing
        return [", ".join(map(str, first)), tested, masked]

    def _stencil(self, stencil: Mapping[str, Any]) -> str:
        sides = (self._stencil_side(stencil[side]) for side in ("front", "back"))
        masks = stencil["reference"], stencil["read_mask"], stencil["write_mask"]
        return _row("true", *sides, *masks)

    def _stencil_side(self, side: Mapping[str, str]) -> str:
        operations = (side[each] for each in ("fail_op", "depth_fail_op", "pass_op"))
        return _row(
            self.word("Compare", side["compare"]),
            *(self.word("StencilOperation", each) for each in operations),
        )


def layouts(material: Material) -> list[str]:
    """The rows of the table of layout ids."""
    return [_row(string(row.name), string(row.layout_id)) for row in material.reflection.blocks]


def identity(material: Material) -> str:
    """What material a reflection has to be of, for a record: its own name, its pass, its rig."""
    row = material.reflection
    return ", ".join(map(string, (row.material, row.pass_, row.rig)))


def plain(name: str) -> str:
    """A name in small letters and underscores, as a part of a longer one."""
    return snake(words(in_ascii(name)))


def identifier(word: str) -> str:
    """A word of a document as an identifier: ``triangle_list``, ``e2d``."""
    name = re.sub(r"\W", "_", word)
    return f"e{name}" if name[0].isdigit() else name


def enumerated(
    opening: str, names: Sequence[str], closing: str, docs: Sequence[str] = ()
) -> list[str]:
    """The lines of an enumeration: one, or as few as hold its names; with ``docs`` one for each."""
    if any(docs):
        lines = ((f"    /// {doc}", f"    {name},") for name, doc in zip(names, docs, strict=True))
        rows = (row for lines_ in lines for row in lines_ if row.strip() != "///")
        return [f"{opening} {{", *rows, closing]
    line = f"{opening} {{ {', '.join(names)} {closing}"
    if len(line) <= WIDTH:
        return [line]
    inside = textwrap.wrap(
        ", ".join(names), WIDTH, initial_indent="    ", subsequent_indent="    ",
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip
    return [f"{opening} {{", *inside, closing]


def chunks(text: str, most: int) -> list[str]:
    """The parts of a text, in whole lines, as some compilers take no longer literals."""
    parts, part = [], ""
    for line in text.splitlines(keepends=True):
        if len(part) + len(line) > most:
            parts.append(part)
            part = ""
        part += line
    return [*parts, part]


def _row(*parts: object) -> str:
    return f"{{{', '.join(map(str, parts))}}}"


def _truth(value: object) -> str:
    return "true" if value else "false"


def _or_none(value: int | None) -> int:
    return -1 if value is None else value


def rows(each: Iterable[Any], row: Callable[[Any], str]) -> list[str]:
    """The rows of a table."""
    return [row(one) for one in each]
