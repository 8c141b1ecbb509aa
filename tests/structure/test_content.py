"""Nothing in the tree speaks of the machine that it was written on."""

from __future__ import annotations

import re

from .kit import ROOT, files

MACHINE_PATH = re.compile(r"(?<![\w./-])(?:/(?:work|home|root|Users|mnt)/\w|[A-Z]:\\\\?Users)")


def test_no_absolute_paths_of_a_machine() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()[:80]}"
        for path in files(ROOT)
        for number, line in enumerate(path.read_text("utf-8", "replace").splitlines(), 1)
        if MACHINE_PATH.search(line)
    ]
    assert not found, "\n".join(found)
