"""Checks the types of modules for three.js by tsc, with those that DefinitelyTyped has of it."""

from __future__ import annotations

import json
from pathlib import Path

from burnish.targets.toolchain.tools import program, tool_named

from ..suite.processes import run

OPTIONS = {
    "target": "es2022",
    "module": "es2022",
    "moduleResolution": "bundler",
    "lib": ["es2022", "dom"],
    "types": [],
    "strict": True,
    "noUncheckedIndexedAccess": True,
    "exactOptionalPropertyTypes": True,
    "verbatimModuleSyntax": True,
    "noEmit": True,
}


def complaints(folder: Path) -> list[str]:
    """What tsc says of the declarations and programs in a folder, when it is strict."""
    found = tool_named("three-types").find()
    assert found is not None
    packages = folder / "node_modules"
    packages.unlink(missing_ok=True)
    packages.symlink_to(found[0].parents[2])
    options = {"compilerOptions": OPTIONS, "include": ["**/*.ts"]}
    (folder / "tsconfig.json").write_text(json.dumps(options), "utf-8")
    node, compiler = program("node", "node"), program("typescript", "tsc")
    assert node is not None
    assert compiler is not None
    return run([str(node), str(compiler), "-p", str(folder)], limit=600).stdout.splitlines()
