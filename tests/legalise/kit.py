"""The shared function of the tests of ``targets/legalise``: materials after the passes."""

from __future__ import annotations

from pathlib import Path

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.passes.lower_stages import lower_stages
from burnish.compiler.passes.pipeline import Options, Staged, stage

EXAMPLES = Path(__file__).parents[2] / "examples"
SINGLE = sorted(path for path in EXAMPLES.glob("*.burnish") if path.stem != "rigs")
"""The examples in which no rig has to be chosen."""


def staged(source: str | Path, pass_: str | None = None) -> Staged:
    """The first material in a text or a file, after the passes of the compiler."""
    report = Report()
    frontend = Frontend(report)
    if isinstance(source, Path):
        module = frontend.open_file(source)
    else:
        module = frontend.open_text(source, "<test>")
    assert module is not None
    shaders = frontend.shaders(module, None, None, pass_)
    assert not report.failed, report.diagnostics
    return stage(lower_stages(shaders[0]), Options())
