"""Runs modules of the host in node, where they need no browser, and checks their types."""

from __future__ import annotations

import json
import shutil
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from burnish.compiler.documents.writing import to_json
from burnish.targets.toolchain.tools import program
from burnish.targets.web_host.checking import write_for_checking
from burnish.targets.web_host.serving.modules import write_modules

from ..suite.processes import run

TARGETS = Path(__file__).parents[2] / "targets"
FOLDER = TARGETS / "web_host"

_SCRIPT = """
{imports}
const read = async () => {{
  const parts = [];
  for await (const part of process.stdin) parts.push(part);
  return JSON.parse(Buffer.concat(parts).toString());
}};
// JSON has no such numbers.
const isShown = (value) => typeof value !== "number" || Number.isFinite(value);
const kept = (_, value) => (isShown(value) ? value : `${{value}}`);
const given = await read();
const body = {body};
console.log(JSON.stringify(given.map(body), kept));
"""


@cache
def _given_out() -> TemporaryDirectory[str]:
    """A folder with the host as pages get it. It is removed when the process ends."""
    folder = TemporaryDirectory(prefix="burnish-host-")
    write_modules(Path(folder.name))
    shutil.copy(FOLDER / "package.json", folder.name)
    return folder


def in_node(
    module: str, name: str, body: str, given: list[Any], *further: tuple[str, str]
) -> list[Any]:
    """The results of a JavaScript function for each of the values ``given``.

    ``body`` is the function's body. It may ``call`` the export ``name`` of ``module``. ``further``
    are other modules, each with a name that it exports.
    """
    modules = Path(_given_out().name)
    imports = [f'import {{ {name} as call }} from "{(modules / module).as_uri()}";']
    imports += [f'import {{ {own} }} from "{(modules / each).as_uri()}";' for each, own in further]
    node = program("node", "node")
    assert node is not None
    script = _SCRIPT.format(imports="\n".join(imports), body=body)
    command = [str(node), "--input-type=module", "--eval", script]
    found: list[Any] = json.loads(run(command, text=json.dumps(to_json(given)), check=True).stdout)
    assert len(found) == len(given)
    return found


def copied(folder: Path) -> None:
    """Copy the host and the page of ``burnish view`` into a folder, with all that a check of their
    types needs."""
    for name in ("web_host", "web_view"):
        ignored = shutil.ignore_patterns("*.py", "__pycache__", "generated")
        shutil.copytree(TARGETS / name, folder / name, ignore=ignored)
    write_for_checking(folder / "web_host")


def checked(folder: Path) -> tuple[set[str], list[str]]:
    """The paths of the files that TypeScript has checked in a folder, and its error messages."""
    node, compiler = program("node", "node"), program("typescript", "tsc")
    assert node is not None
    assert compiler is not None
    lines = run([str(node), str(compiler), "-p", str(folder), "--listFiles"]).stdout.splitlines()
    files = {line for line in lines if Path(line).is_file()}
    return files, [line for line in lines if line not in files]


def too_long(folder: Path) -> list[str]:
    """The lines of a folder's modules that are longer than the tree's may be."""
    return [
        f"{path.relative_to(folder)}:{number}"
        for path in folder.rglob("*.js")
        if path.parent.name != "generated"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 100
    ]
