"""Executes a command line of ``burnish compile``: compiles, writes and reports.

``cli.py`` calls ``succeeds`` for plain command lines, ``compile.py`` for those that click has read.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from ..support.frozen import changed
from .compile_options import CompileRequest
from .compiled_files import compiled
from .compiled_record import Compiled
from .console import rendered, show
from .results import STDOUT, Output, Question, keep
from .terminal import print_output


def succeeds(request: CompileRequest, question: Question | None) -> bool:
    """Compile once and report the diagnostics; True if there was any output.

    ``question`` is the key under which the output is kept, if it is to be kept.
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    request = changed(request, files=tuple(dict.fromkeys(request.files)))
    found = list(_told(request, question))
    diagnostics = [one for each in found for one in each.diagnostics]
    inputs = [each.inputs for each in found if each.inputs is not None]
    if len(inputs) < len(found):
        show(diagnostics)
        return False
    try:
        output = _output(request, found, rendered(diagnostics))
        _deliver(output)
    except CompileError as error:
        show((*diagnostics, *error.diagnostics))
        return False
    show(diagnostics)
    if question is not None:
        first, *others = inputs
        keep(question, output, first.joined(others))
    return True


def _told(request: CompileRequest, question: Question | None) -> Iterable[Compiled]:
    """What each file becomes; a terminal shows how far it is with many."""
    if len(request.files) == 1:
        return [compiled(request)]
    from .many_files import compiled_files

    return _with_progress(compiled_files(request, question), len(request.files))


def _with_progress(found: Iterable[Compiled], count: int) -> Iterator[Compiled]:
    from .progress import Progress

    with Progress("compiling") as progress:
        for number, each in enumerate(found, 1):
            yield each
            progress.tell(number / count)


def _output(request: CompileRequest, found: Sequence[Compiled], warnings: str) -> Output:
    """The output of a command line: files in a folder, or shaders on standard output.

    Raises ``CompileError`` if two files want to write one.
    """
    if request.prints:
        texts = [text for each in found for text in each.texts.items()]
        headings = (f"// ======== {name}\n" if len(texts) > 1 else "" for name, _ in texts)
        printed = (heading + text for heading, (_, text) in zip(headings, texts, strict=True))
        return Output(STDOUT, {}, "".join(printed), warnings)
    _insist_on_one_file_for_each(request.files, found)
    lines = [line for each in found for line in each.lines]
    lines += dict.fromkeys(remark for each in found for remark in each.remarks)
    # Reflections are put in place behind the shaders, and plans last: whoever sees a new one finds
    # what it describes.
    written = (
        *(each.texts for each in found),
        *(each.reflections for each in found),
        *(each.plans for each in found),
    )
    whole = {name: text for part in written for name, text in part.items()}
    return Output(request.output, whole, "".join(lines), warnings)


def _insist_on_one_file_for_each(files: Sequence[Path], found: Sequence[Compiled]) -> None:
    """Raise ``CompileError`` if what one file becomes would replace what another one becomes.

    Names that differ in capital letters only are one file on many disks.
    """
    from ..compiler.diagnostics import rules
    from ..compiler.diagnostics.diagnostic import CompileError, Report

    report, owners = Report(), dict[str, Path]()
    for file, each in zip(files, found, strict=True):
        for name in _names(each):
            owner = owners.setdefault(name.casefold(), file)
            if owner != file:
                report.add(rules.SAME_OUTPUT, None, name=name, first=owner, second=file)
                break
    if report.failed:
        raise CompileError(report.diagnostics)


def _names(found: Compiled) -> Iterator[str]:
    parts: tuple[Mapping[str, str], ...] = (found.texts, found.reflections, found.plans)
    for part in parts:
        yield from part


def _deliver(output: Output) -> None:
    """Write the files and print the texts, or raise ``CompileError``."""
    from .output import unwritable, write_all

    if output.folder != STDOUT:
        write_all(Path(output.folder), output.texts)
    try:
        print_output(output.printed)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise unwritable(Path("standard output"), error.strerror or str(error)) from error
