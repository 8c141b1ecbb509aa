"""The generated modules of the host: ``targets/web_host/generated``.

``test_modules.py`` compares them with what is in the tree, and writes them anew.
"""

from __future__ import annotations

import json
from pathlib import Path

from burnish.targets.toolchain.tools import program

from ..suite.processes import run
from .builtin_table import table
from .document_types import whole_schema

_BANNER = "// Generated from {} by the tests: do not edit."
_PRETTIER = "--print-width=100"


def generated_modules(folder: Path) -> dict[str, str]:
    """The text of each module by its name; ``folder`` is for a file of the tool's."""
    return {"builtins.ts": _builtins(), "documents.ts": _documents(folder)}


def _builtins() -> str:
    banner = _BANNER.format("compiler/reference, which says what builtins mean,")
    text = f"{banner}\n{table()}"
    return _node("prettier.cjs", "--parser", "typescript", _PRETTIER, text=text)


def _documents(folder: Path) -> str:
    schema = folder / "documents.json"
    schema.write_text(json.dumps(whole_schema()), encoding="utf-8")
    banner = _BANNER.format("the JSON Schemas of packages, plans and reflections")
    further = ("--bannerComment", banner, "--style.printWidth", "100")
    return _node("cli.js", "--input", str(schema), *further)


def _node(name: str, *arguments: str, text: str = "") -> str:
    node, script = program("node", "node"), program("json-schema-to-typescript", name)
    assert node is not None
    assert script is not None
    return run([str(node), str(script), *arguments], text=text, check=True).stdout
