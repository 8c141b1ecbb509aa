"""Runs modules of the host in node, where they need no browser."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from burnish.compiler.documents.writing import to_json
from burnish.targets.toolchain.tools import program

from ..suite.processes import run

FOLDER = Path(__file__).parents[2] / "targets" / "web_host"
MODULES = FOLDER / "modules"

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


def in_node(
    module: str, name: str, body: str, given: list[Any], *further: tuple[str, str]
) -> list[Any]:
    """What a JavaScript function of one argument, which may ``call`` what a module exports, makes
    of each thing that is given. ``further`` are other modules, each with a name that it exports."""
    imports = [f'import {{ {name} as call }} from "{(MODULES / module).as_uri()}";']
    imports += [f'import {{ {own} }} from "{(MODULES / each).as_uri()}";' for each, own in further]
    node = program("node", "node")
    assert node is not None
    script = _SCRIPT.format(imports="\n".join(imports), body=body)
    command = [str(node), "--input-type=module", "--eval", script]
    found: list[Any] = json.loads(run(command, text=json.dumps(to_json(given)), check=True).stdout)
    assert len(found) == len(given)
    return found
