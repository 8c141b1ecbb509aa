"""Draws all examples by three.js's ``WebGLRenderer``.

``python -m burnish.tests.engines.webgl_suite [NAME...]`` prints a row for each material: whether
all that it draws lies inside the bounds of its meaning, or why it is not drawn. The tests do this
with a few of them.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Error, Page

from burnish.compiler.diagnostics.diagnostic import CompileError

from . import webgl
from .files import EXAMPLES
from .kit import page_of, site_in

_RIG = re.compile(r"^rig (\w+)", re.M)


def main(names: Sequence[str]) -> int:
    """Print the rows and their sum; returns the process's exit code."""
    verdicts: Counter[str] = Counter()
    with TemporaryDirectory() as folder:
        site = site_in(Path(folder), "draw_webgl.html")
        with page_of(site) as page:
            for file in sorted(EXAMPLES.glob("*.burnish")):
                if not names or file.stem in names:
                    for label, verdict, why in _verdicts(file, site, page):
                        verdicts[verdict] += 1
                        print(f"{label}: {verdict}{why and ': '}{why}", flush=True)
    print(", ".join(f"{count} {verdict}" for verdict, count in verdicts.items()))
    return 1 if verdicts["disagrees"] else 0


def _verdicts(file: Path, site: Path, page: Page) -> Iterator[tuple[str, str, str]]:
    """Labels with verdicts and reasons."""
    folder = site / file.stem
    folder.mkdir()
    copy = webgl.copied(file, folder)
    rigs = _RIG.findall(file.read_text(encoding="utf-8"))
    rig = rigs[0] if len(rigs) > 1 else None
    try:
        found = webgl.materials(copy, file, rig)
        for material in found:
            webgl.module_in(folder, material)
    except CompileError as error:
        yield file.stem, "not drawn", str(error).splitlines()[0]
        return
    try:
        golden = webgl.golden_in(folder, copy, file, *(("--rig", rig) if rig else ()))
    except AssertionError as error:
        yield file.stem, "not judged", str(error).splitlines()[0]
        return
    for material in found:
        cases = list(webgl.cases_of(golden, material.name))
        wrong = ""
        for case in cases:
            try:
                webgl.assert_drawn(page, file.stem, material, golden, case)
            except (AssertionError, Error) as error:
                wrong = " ".join(str(error).split())[:300]
                break
        verdict = "disagrees" if wrong else "agrees" if cases else "not judged"
        yield f"{file.stem}.{material.name}", verdict, wrong or f"{len(cases)} cases"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
