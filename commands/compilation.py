"""Executes a command line of ``burnish compile``: compiles, writes and reports.

``cli.py`` calls ``succeeds`` for plain command lines, ``compile.py`` for those that click has read.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..support.frozen import changed
from .compile_options import CompileRequest
from .compiled_files import compiled
from .compiled_record import Compiled
from .console import print_rendered
from .results import STDOUT, Output, Question, keep
from .terminal import print_output
from .written_files import owners_of, written_of

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic
    from ..compiler.inputs import Inputs


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
        return _failed(request, diagnostics)
    first, *others = inputs
    together = first.joined(others)
    try:
        output = _output(request, found, together, diagnostics)
        _deliver(output)
    except CompileError as error:
        return _failed(request, (*diagnostics, *error.diagnostics))
    print_rendered(output.warnings)
    if question is not None:
        keep(question, output, together)
    return True


def _failed(request: CompileRequest, diagnostics: Sequence[Diagnostic]) -> bool:
    """Report why there is no output; False."""
    from .message_forms import tell

    return tell(request.form, "compile", diagnostics)


def _warnings(request: CompileRequest, diagnostics: Sequence[Diagnostic]) -> str:
    """The text for standard error. Most compiles have nothing to say, and load nothing for it."""
    if not diagnostics:
        return ""
    from .message_forms import messages

    return messages(request.form, diagnostics)


def _told(request: CompileRequest, question: Question | None) -> Iterable[Compiled]:
    """What each file becomes; a terminal shows how far it is with many."""
    if len(request.files) == 1:
        return [compiled(request)]
    from .many_files import compiled_files

    return with_progress(compiled_files(request, question), len(request.files))


def with_progress(found: Iterable[Compiled], count: int) -> Iterator[Compiled]:
    """What ``count`` files become; a terminal shows how far it is."""
    from .progress import Progress

    with Progress("compiling") as progress:
        for number, each in enumerate(found, 1):
            yield each
            progress.tell(number / count)


def _output(
    request: CompileRequest,
    found: Sequence[Compiled],
    inputs: Inputs,
    diagnostics: Sequence[Diagnostic],
) -> Output:
    """The output of a command line: files in a folder, or shaders on standard output.

    Raises ``CompileError`` if it would write one file twice.
    """
    warnings = _warnings(request, diagnostics)
    if request.prints:
        depfile = _depfile(request, (), inputs)
        return Output(STDOUT, {}, {}, depfile, _printed(found), warnings)
    contents = written_of(request.files, found)
    paths = [os.path.join(request.output, name) for name in contents]  # noqa: PTH118
    lines = [line for each in found for line in each.lines]
    lines += dict.fromkeys(remark for each in found for remark in each.remarks)
    if request.list_outputs:
        lines = [f"{path}\n" for path in paths]
    printed = "".join(lines)
    if request.form not in ("text", "line"):
        printed = _document(request, found, inputs, diagnostics, lines)
    if request.list_outputs:
        return Output(STDOUT, {}, {}, printed=printed, warnings=warnings)
    owners = owners_of(request.files, found)
    depfile = _depfile(request, paths, inputs)
    return Output(request.output, contents, owners, depfile, printed, warnings, request.force)


def _document(
    request: CompileRequest,
    found: Sequence[Compiled],
    inputs: Inputs,
    diagnostics: Sequence[Diagnostic],
    lines: Sequence[str],
) -> str:
    """The document for standard output."""
    from .compile_answer import compile_answer
    from .message_forms import document

    answer = compile_answer(request, found, inputs, lines)
    written = [] if request.list_outputs else [row.path for row in answer.outputs]
    if request.depfile is not None:
        written.append(request.depfile)
    return document(
        request.form, "compile", diagnostics, exit_code=0, written=written, found=answer
    )


def _printed(found: Sequence[Compiled]) -> str:
    """All shaders, each below its name if there are several."""
    texts = [text for each in found for text in each.texts.items()]
    headings = (f"// ======== {name}\n" if len(texts) > 1 else "" for name, _ in texts)
    return "".join(heading + text for heading, (_, text) in zip(headings, texts, strict=True))


def _depfile(request: CompileRequest, paths: Sequence[str], inputs: Inputs) -> tuple[str, ...]:
    """The path and the text of the file that ``--depfile`` asks for; empty without it.

    Raises ``CompileError`` if a name cannot be written in it.
    """
    if request.depfile is None:
        return ()
    from .depfiles import depfile_of

    targets = paths if request.depfile_target is None else [request.depfile_target]
    return request.depfile, depfile_of(
        request.depfile, targets, paths, request.files, inputs, force=request.force
    )


def _deliver(output: Output) -> None:
    """Write the files and print the texts, or raise ``CompileError``."""
    from .output import unwritable, write_all, write_file

    if output.folder != STDOUT:
        write_all(Path(output.folder), output.texts, output.guard())
    try:
        if output.depfile:
            path, text = output.depfile
            write_file(Path(path), text.encode())
    except OSError as error:
        raise unwritable(Path(output.depfile[0]), error.strerror or str(error)) from error
    try:
        print_output(output.printed)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise unwritable(Path("standard output"), error.strerror or str(error)) from error
