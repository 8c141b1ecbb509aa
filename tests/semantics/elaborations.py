"""All that semantics says of programs, to compare it with and without what a process keeps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Span
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.ir.shader import Shader
from burnish.compiler.semantics.shading import assembly
from burnish.compiler.semantics.shading.kept_bodies import KeptBodies
from burnish.compiler.semantics.shading.kept_transcripts import KeptTranscripts
from burnish.compiler.semantics.state.context import KeptBody, Signature
from burnish.compiler.semantics.state.transcripts import Kept, LibraryPart


class NoTranscripts(KeptTranscripts):
    """Keeps nothing, so that every equation is checked."""

    def of(self, _part: LibraryPart) -> Kept:
        """No transcripts."""
        return {}


class NoBodies(KeptBodies):
    """Keeps nothing, so that every function is checked."""

    def of(self, _signature: Signature, _parts: tuple[Node, ...]) -> KeptBody | None:
        """No body."""
        return None


def keep_nothing(patch: pytest.MonkeyPatch) -> None:
    """Has everything checked in each elaboration."""
    patch.setattr(assembly, "KEPT_TRANSCRIPTS", NoTranscripts())
    patch.setattr(assembly, "KEPT_BODIES", NoBodies())


def elaborated(source: str | Path) -> list[str]:
    """All that semantics says of a program: messages, nodes, and notes about them."""
    report = Report()
    opened = Frontend(report)
    if isinstance(source, str):
        module = opened.open_text(source, "<text>")
    else:
        module = opened.open_file(source)
    assert module is not None
    if opened.has_frames(module, None):
        frames = opened.frames(module, None, None)
        shaders: list[Shader] = [each.shader for frame in frames for each in frame.shaders]
    else:
        shaders = opened.shaders(module, None, None, None)
    return [render_all(report.diagnostics), *(line for s in shaders for line in _described(s))]


def checked(source: str | Path) -> list[str]:
    """The same where nothing is kept."""
    with pytest.MonkeyPatch.context() as patch:
        keep_nothing(patch)
        return elaborated(source)


def _described(shader: Shader) -> Iterator[str]:
    nodes = reachable([result.value for result in shader.results])
    yield from map(repr, nodes)
    for result in shader.results:
        yield f"{result.kind} {result.name} %{result.value.id}"
    for node in nodes:
        yield f"%{node.id}: {_notes(shader, node)}"
    infos = (*shader.parameters, *shader.textures, *shader.attributes, *shader.buffers)
    for info in infos:
        yield f"{info.leaf} {info.doc} {shown(info.span)}"


def _notes(shader: Shader, node: Node) -> list[str]:
    return [shown(table.get(node.id)) for table in shader.notes.tables]


def shown(noted: object) -> str:
    """A note as a text that is the same in all processes."""
    if isinstance(noted, Span):
        return f"{noted.source.name} {noted.start}..{noted.end}"
    return repr(noted)
