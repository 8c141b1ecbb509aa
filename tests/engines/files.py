"""The files of engines that tests ask for: of examples, by the commands' own functions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from burnish.api.compiling_engines import functions_for
from burnish.compiler.diagnostics.diagnostic import CompileError, Report
from burnish.engines import known
from burnish.engines.fitting import files as files_for
from burnish.support.frozen import EMPTY

EXAMPLES = Path(__file__).parents[2] / "examples"
MATERIAL = re.compile(r"^material (\w+)", re.M)


def materials(names: Sequence[str] = ()) -> Iterator[tuple[Path, str]]:
    """The materials of the examples, or of those named, each with its file."""
    for file in sorted(EXAMPLES.glob("*.burnish")):
        if not names or file.stem in names:
            for name in MATERIAL.findall(file.read_text("utf-8")):
                yield file, name


def files_of(
    engine: str, source: Path | str, material: str, named: Mapping[str, str] = EMPTY
) -> Mapping[str, str]:
    """The files of an engine for one material. Raises ``CompileError``."""
    row = known.load(engine)
    found = functions_for(row, source, material=material, named=named)
    files, report = dict[str, str](), Report()
    for each in found:
        emissions = {f"{file.target}:{file.profile}": file.emission for file in each.files}
        files |= files_for(row, each.document, emissions, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    return files


def texts_of(engine: str) -> tuple[dict[str, str], dict[str, str]]:
    """The file of each material of the examples, and why others have none, by ``file.material``."""
    texts, reasons = {}, {}
    for file, name in materials():
        label = f"{file.stem}.{name}"
        try:
            (texts[label],) = files_of(engine, file, name).values()
        except CompileError as error:
            reasons[label] = str(error).splitlines()[0]
    return texts, reasons


def summary(texts: Mapping[str, str], reasons: Mapping[str, str]) -> str:
    """A line for each material, for a golden file."""
    lines = {**dict.fromkeys(texts, "written"), **reasons}
    return "".join(f"{label}: {line}\n" for label, line in sorted(lines.items()))
