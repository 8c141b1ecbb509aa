"""The generated modules of the host: ``targets/web_host/generated``.

``test_modules.py`` compares them with what is in the tree, and writes them anew.
"""

from __future__ import annotations

from burnish.compiler.documents.typescript import typescript
from burnish.targets.toolchain.tools import program
from burnish.targets.web_host.documents import Package

from ..suite.processes import run
from .builtin_table import table

_BANNER = "// Generated from {} by the tests: do not edit."
_PRETTIER = "--print-width=100"


def generated_modules() -> dict[str, str]:
    """The text of each module by its name; ``folder`` is for a file of the tool's."""
    return {"builtins.ts": _builtins(), "documents.ts": _documents()}


def _builtins() -> str:
    banner = _BANNER.format("compiler/reference, which says what builtins mean,")
    text = f"{banner}\n{table()}"
    return _node("prettier.cjs", "--parser", "typescript", _PRETTIER, text=text)


def _documents() -> str:
    banner = _BANNER.format("the records of documents (compiler/documents, documents.py)")
    return f"{banner}\n\n{typescript(Package)}"


def _node(name: str, *arguments: str, text: str = "") -> str:
    node, script = program("node", "node"), program("json-schema-to-typescript", name)
    assert node is not None
    assert script is not None
    return run([str(node), str(script), *arguments], text=text, check=True).stdout
