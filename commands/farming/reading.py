"""Reads the files of a run, with all that they import, to send them to workers."""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.diagnostics.diagnostic import CompileError, Report
from ...compiler.frontend import Frontend
from ...compiler.inputs import Inputs
from ..compared import ConformRequest


def inputs_of(request: ConformRequest) -> Iterator[Inputs]:
    """What each file of a request reads. Raises ``CompileError`` if one cannot be read."""
    report = Report()
    for file in request.files:
        inputs = Inputs()
        Frontend(report, request.search_path, inputs).open_file(file)
        yield inputs
    if report.failed:
        raise CompileError(report.diagnostics)
