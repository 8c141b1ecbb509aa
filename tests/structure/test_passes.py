"""A pass is found under its name: its module in ``compiler/passes`` is called after it."""

from __future__ import annotations

import re
from pathlib import Path

import burnish.compiler.passes

PASSES = Path(burnish.compiler.passes.__path__[0])


def test_each_pass_stands_in_the_module_of_its_name() -> None:
    pipeline = (PASSES / "pipeline.py").read_text()
    names = set(re.findall(r'verified\(\s*"(\w+)"', pipeline)) - {"semantics"}
    assert len(names) > 10
    assert {name for name in names if not (PASSES / f"{name}.py").exists()} == set()
