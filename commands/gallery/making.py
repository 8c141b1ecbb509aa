"""Makes the entry of one file: its texts, graphs, pictures and verdicts, as the commands make them.

``worker.py`` keeps a ``Maker`` in each of the gallery's processes, so that drivers start once.
"""

from __future__ import annotations

import base64
import os
import shlex
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from hashlib import blake2b
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ...api.compiled import CompiledFrame, CompiledMaterial
from ...api.entry_points import equations
from ...compiler.budget import BudgetError
from ...compiler.diagnostics import rules
from ...compiler.diagnostics.diagnostic import CompileError, Report
from ...compiler.inputs import Inputs
from ...compiler.ir.stages import COMPUTED
from ...targets.closing import Closing
from ...targets.conformance import summary
from ...targets.conformance.conform import conform as compare
from ...targets.runner.files import FileError, opened, read_file
from ...targets.runner.pictures import encoded
from ...targets.runner.routes import Route
from ...targets.runner.runner import Runner
from ...targets.selection import DEFAULT, full_name, select_targets
from ...targets.toolchain import Toolchain
from .. import compared, panels, subjects
from ..catalogue import ENDING, is_shown
from ..comments import asked, files_of
from ..conform import conform
from ..failures import errors_as_messages
from ..graph.command import as_svg
from ..picture_files import moving
from ..progress import Progress
from ..render import render
from .entry import Entry, Figure, Graph, Program, Stage, Text, Verdict, failed

if TYPE_CHECKING:
    from ...targets.conformance.rows import Row
    from ...targets.runner.sheet import Panel

EVOLVED = 24
"""The number of frames that are drawn if something changes from frame to frame."""
LARGEST_SOURCE = 1 << 18
"""The most bytes of a file that is shown."""
_NAME = "file"
"""A placeholder for a file in command lines, where its own name could be taken for an option."""


class Maker(Closing):
    """Makes entries; owns the drivers that draw."""

    def __init__(self, routes: Sequence[Route], shown: Sequence[Route], size: int) -> None:
        """``routes`` are compared with the reference; ``shown`` draw the pictures beside its
        own."""
        self._routes, self._shown, self._size = routes, shown, size
        every = dict.fromkeys([*routes, *shown])
        self._runner = Runner(every, parallel=1)
        self._toolchain = Toolchain()

    def close(self) -> None:
        """End the drivers."""
        self._runner.close()
        self._toolchain.close()

    def entry(self, file: Path) -> Entry:
        """Everything about one file of the current folder. Errors are part of it."""
        source, problem = source_of(file, Path.cwd())
        entry = failed(source, problem)
        if problem:
            return entry
        entry["errors"] = []
        _Making(self._routes, self._shown, self._size, self._runner, self._toolchain, file,
                entry).run()  # fmt: skip
        return entry


class _Making:
    """The entry of one file, while it is made."""

    def __init__(
        self,
        routes: Sequence[Route],
        shown: Sequence[Route],
        size: int,
        runner: Runner,
        toolchain: Toolchain,
        file: Path,
        entry: Entry,
    ) -> None:
        self._routes, self._shown, self._size = routes, shown, size
        self._runner, self._toolchain = runner, toolchain
        self._file, self._entry = file, entry

    def run(self) -> None:
        words = ["--routes", "all", _NAME]
        found: compared.Subjects = []
        with self._told(conform, words) as chosen:
            request = compared.ConformRequest(**{**chosen, "files": (self._file,)})
            inputs: list[Inputs] = []
            further = [*_profiles(), *(route.profile for route in self._shown)]
            try:
                found = compared.subjects_of(
                    request, self._routes, native_stages=False, further=further, read=inputs.append
                )
            except CompileError as error:
                if {found.rule for found in error.diagnostics} != {rules.NO_MATERIAL}:
                    _insist_on_shown(error)
                    raise
                self._entry["kinds"].append("module")
                inputs.append(_alone(self._file))
            self._entry["inputs"] = _digests(inputs)
        if self._entry["errors"]:
            return
        self._name(found)
        self._texts(found)
        if not found:
            return
        self._draw(found)
        with self._told(conform, words):
            self._compare(found)

    @contextmanager
    def _told(self, command: click.Command, words: Sequence[str]) -> Iterator[dict[str, Any]]:
        """The options of a command; errors inside the ``with`` block become part of the entry."""
        said = StringIO()
        try:
            with (
                redirect_stderr(said),
                redirect_stdout(said),
                command.make_context(command.name, list(words)) as context,
                errors_as_messages(),
            ):
                yield context.params
        except click.exceptions.Exit:
            self._entry["errors"].append(said.getvalue().strip())
        except click.ClickException as error:
            self._entry["errors"].append(error.format_message())
        else:
            self._entry["notes"] += filter(None, [said.getvalue().strip()])

    def _name(self, found: compared.Subjects) -> None:
        """Note the kinds and names of the subjects."""
        for _label, subject in found:
            if isinstance(subject, CompiledFrame):
                kind = "frame"
            else:
                kind = "kernel" if subject.shader.chain == COMPUTED else "material"
            if kind not in self._entry["kinds"]:
                self._entry["kinds"].append(kind)
            if subject.name not in self._entry["names"]:
                self._entry["names"].append(subject.name)

    # --- texts and graphs ---

    def _texts(self, found: compared.Subjects) -> None:
        for label, subject in found:
            name = label.rpartition(": ")[2]
            self._entry["graphs"].append(_graph(name, self._file, subject))
            if isinstance(subject, CompiledFrame):
                self._entry["programs"] += (_program(s.name, s) for s in subject.shaders)
            else:
                self._entry["programs"].append(_program(name, subject))

    # --- pictures ---

    def _draw(self, found: compared.Subjects) -> None:
        options = self._options(found)
        routes: list[Route | None] = [None, *self._shown]
        words = ["--size", str(self._size), "-o", "picture.png", _NAME]
        with self._told(render, words) as chosen:
            # With all routes, a route that lacks something is no error.
            # The comment's options are among these already.
            whole = {
                **chosen,
                "plain": True,
                **options,
                "file": self._file,
                "on": (subjects.EVERYTHING,),
            }
            request = subjects.RenderRequest(**whole)
            self._entry["inputs"] |= _digests_of_files(request.values)
            usable = [route for route in self._shown if self._runner.problem(route) is None]
            drawn = subjects.subjects(request, usable, lambda _share: None)
            for times in panels.panels(
                drawn, routes, request, self._runner, self._toolchain, Progress("drawing")
            ):
                # All outputs of a subject share the panel that says why they are missing.
                for same in dict.fromkeys(zip(*times, strict=True)):
                    self._figure(same)

    def _options(self, compiled: compared.Subjects) -> Mapping[str, Any]:
        """Options for drawing that differ from the defaults; the page shows the command.

        The file's comment asks for them. Without a comment, several frames are drawn if a frame
        goes on from the last one.
        """
        found = asked(self._entry["source"], self._file.name, Path.cwd(), self._size, render)
        if found.note:
            self._entry["notes"].append(found.note)
        words, options = found.words, found.options
        if not words:
            # A name that begins with a dash would be taken for an option.
            before = "./" if self._file.name.startswith("-") else ""
            frames = [each for _label, each in compiled if isinstance(each, CompiledFrame)]
            evolves = any(frame.plan.kept for frame in frames)
            output = f"{before}{self._file.stem}{'.webp' if evolves else '.png'}"
            words = [f"{before}{self._file.name}", "-o", output]
            if evolves:
                words += ["--frames", str(EVOLVED)]
                options = {"frames": EVOLVED}
        self._entry["command"] = shlex.join(["burnish", "render", *words])
        return options

    def _figure(self, times: Sequence[Panel]) -> None:
        """Add the pictures of an output by a route: a panel for each time that it is drawn."""
        last = times[-1]
        *titles, route = last.titles
        label, images = ", ".join(titles), [panel.image for panel in times if panel.image]
        name = f"{len(self._entry['figures'])}-{route.replace(':', '-')}"
        figure: Figure = {
            "label": label, "route": route, "note": last.note, "picture": "", "moving": "",
            "status": last.problem or "drawn",
        }  # fmt: skip
        if images:
            figure["picture"] = self._picture(f"{name}.png", encoded(images[-1], Path("a.png")))
        if len(images) > 1:
            figure["moving"] = self._picture(f"{name}.webp", moving(images, Path("a.webp")))
        self._entry["figures"].append(figure)
        if last.problem == panels.BROKEN:
            self._entry["errors"].append(f"{label}, {route}: {last.note}")

    def _picture(self, name: str, content: bytes) -> str:
        self._entry["pictures"][name] = base64.b64encode(content).decode("ascii")
        return name

    # --- verdicts ---

    def _compare(self, found: compared.Subjects) -> None:
        rows = compare(found, self._routes, self._runner, self._toolchain)
        for label, own in summary.by_material(rows).items():
            said = {
                row.route.name: lines for some, lines in summary.messages(own) for row in some[:1]
            }
            for row in own:
                self._entry["verdicts"].append(_verdict(label, row, said.get(row.route.name, ())))
                if summary.is_failure(row, strict=False):
                    lines = "\n".join(said.get(row.route.name, ()))
                    self._entry["errors"].append(
                        f"{label}, {row.route.name}: {row.status}\n{lines}"
                    )


def _verdict(label: str, row: Row, lines: Sequence[str]) -> Verdict:
    route, status, difference, share, bite, unproven = summary.cells(row)
    device = "" if row.device is None else row.device.title
    return {
        "label": label.rpartition(": ")[2], "route": route, "title": row.route.title,
        "status": status, "difference": difference, "share": share, "bite": bite,
        "unproven": unproven, "problem": row.problem, "device": device, "lines": list(lines),
    }  # fmt: skip


def _profiles() -> list[str]:
    """The profiles whose texts are shown, by their full names: the first one of each language."""
    return [full_name(language, profile) for language, profile in
            select_targets([DEFAULT], Report(), single_file=False)]  # fmt: skip


def _program(label: str, material: CompiledMaterial) -> Program:
    """The texts of a material, stage by stage."""
    profiles = _profiles()
    stages: dict[str, list[Text]] = {}
    for file in material.files:
        if f"{file.target}:{file.profile}" in profiles:
            text: Text = {"language": file.target, "file": file.name, "text": file.text}
            stages.setdefault(file.stage, []).append(text)
    found: list[Stage] = [{"name": name, "texts": texts} for name, texts in stages.items()]
    lacks = [f"{name}: {why}" for name, why in material.lacking.items() if name in profiles]
    return {"label": label, "stages": found, "lacking": lacks}


def _graph(label: str, file: Path, subject: CompiledFrame | CompiledMaterial) -> Graph:
    """The steps of a frame, the equations of a material, or the program of a kernel."""
    try:
        if isinstance(subject, CompiledFrame) or subject.shader.chain == COMPUTED:
            return {"label": label, "svg": as_svg(subject), "problem": ""}
        drawn_by = {"rig": subject.shader.rig_name, "pass_": subject.shader.pass_name}
        (found,) = equations(file, material=subject.shader.name, **drawn_by)
        return {"label": label, "svg": as_svg(found), "problem": ""}
    except CompileError as error:
        return {"label": label, "svg": "", "problem": error.diagnostics[0].message}


def _alone(file: Path) -> Inputs:
    """The dependencies of a file that others import, without those of the imported files."""
    inputs = Inputs()
    inputs.read(file, file.read_bytes())
    return inputs


def _digests(read: Sequence[Inputs]) -> dict[str, str]:
    """The digests of all files that were read, by their paths."""
    contents = {path: content for inputs in read for path, content in inputs.contents.items()}
    return {path: digest_of(content) for path, content in contents.items()}


def _insist_on_shown(error: CompileError) -> None:
    """Raise ``ClickException`` for errors in an imported file that the gallery does not show.

    Such a file may be hidden, or no source at all, and the errors quote its lines.
    """
    spans = [
        span for found in error.diagnostics
        for span in (found.span, *(label.span for label in found.labels)) if span is not None
    ]  # fmt: skip
    for name in dict.fromkeys(span.source.name for span in spans):
        # Files of the library have names that are no paths.
        if os.path.lexists(name) and not is_shown(Path(name), Path.cwd(), ENDING):
            raise click.ClickException(
                f"the file imports `{name}`, which is no file that a gallery shows, and there are "
                "errors in it"
            )


def source_of(file: Path, root: Path) -> tuple[str, str]:
    """The text of a file of a folder, and the reason why it is not shown; one of them is empty."""
    if not is_shown(file, root, ENDING):
        return "", "it is not a file of the folder any more"
    try:
        with opened(file, "the file") as content:
            data = content.read(LARGEST_SOURCE + 1)
    except (FileError, BudgetError) as error:
        return "", str(error)
    if len(data) > LARGEST_SOURCE:
        return "", f"a gallery shows files of up to {LARGEST_SOURCE >> 10} kB, and it is larger"
    return data.decode("utf-8", "replace"), ""


def _digests_of_files(values: Sequence[tuple[str, str]]) -> dict[str, str]:
    """The digests of the files from which values are read: pictures, and elements of buffers."""
    paths = (path for _name, text in values for path in files_of(text, Path.cwd()))
    return {str(path.resolve()): digest_of(content_of(path)) for path in paths}


def content_of(path: Path) -> bytes | None:
    """The contents of a file; ``None`` if there is no file, or it cannot be read."""
    try:
        return read_file(path, path.name)
    except (FileError, BudgetError):
        return None


def digest_of(content: bytes | None) -> str:
    """The digest of a file; empty for a file that does not exist."""
    return "" if content is None else blake2b(content, digest_size=20).hexdigest()
