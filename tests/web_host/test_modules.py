"""The modules of the host: their types, what is given out of them, and how large they are."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from burnish.targets.toolchain.sources import OwnInstaller
from burnish.targets.toolchain.tools import tool_named
from burnish.targets.web_host.serving.builtin_table import builtins_module
from burnish.targets.web_host.serving.modules import BUILTINS, SHAPES, host_modules, write_modules

from ..structure.kit import ROOT, files
from . import size
from .kit import FOLDER, checked, copied, too_long


def test_the_types_are_right(tmp_path: Path) -> None:
    copied(tmp_path)
    seen, wrong = checked(tmp_path / "web_host")
    assert not wrong
    assert {str(tmp_path / "web_host" / name) for name in host_modules()} <= seen


MISTAKES = [
    ("resources.js", "this.#from.formats[number]", "this.#from.format[number]",
     "error TS2551: Property 'format' does not exist on type 'Package'. "
     "Did you mean 'formats'?"),
    ("bytes.js", "present(/\\d+/.exec(format))", "/\\d+/.exec(format)",
     "error TS2531: Object is possibly 'null'."),
    ("steps.js", "WHOLE[[name, kind, ...shapes].join(\" \")]", "WHOLE.join(name)",
     "error TS2349: This expression is not callable."),
    ("webgpu/device.js", "GPUBufferUsage.MAP_READ", "GPUBufferUsage.READ",
     "error TS2339: Property 'READ' does not exist on type 'Constants<"),
]  # fmt: skip
"""A module, a text in it, what replaces the text, and the error about that. The modules differ."""


@pytest.fixture(scope="module")
def errors(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The errors about a host with all of ``MISTAKES``: TypeScript takes seconds to read a host."""
    folder = tmp_path_factory.mktemp("mistakes")
    copied(folder)
    for module, old, new, _ in MISTAKES:
        path = folder / "web_host" / module
        text = path.read_text("utf-8")
        assert old in text
        path.write_text(text.replace(old, new), "utf-8")
    return checked(folder / "web_host")[1]


@pytest.mark.xdist_group("mistakes in the host")
@pytest.mark.parametrize(("module", "error"), [(row[0], row[3]) for row in MISTAKES])
def test_wrong_types_are_found(errors: list[str], module: str, error: str) -> None:
    assert [line for line in errors if f"{module}(" in line and error in line], errors


def test_nothing_in_the_tree_is_made_of_something_else_in_it() -> None:
    """Neither compiled modules nor generated ones; types alone stand in files of TypeScript.

    The comparer in TypeScript is what people copy, and nothing is made of it.
    """
    texts = [
        path
        for path in files(ROOT / "targets")
        if path.suffix in (".ts", ".js", ".mjs") and path.parent.name != "comparers"
    ]
    assert not [path for path in texts if path.name.endswith(".ts") and ".d." not in path.name]
    assert not [path for path in texts if path.read_text("utf-8") == builtins_module()]
    ignored = (ROOT / ".gitignore").read_text("utf-8").splitlines()
    assert "/targets/web_host/generated/" in ignored


def test_all_modules_are_given_out(tmp_path: Path) -> None:
    """The modules are those of the tree, and two generated ones."""
    write_modules(tmp_path / "host")
    written = [path for path in (tmp_path / "host").rglob("*") if path.is_file()]
    given = {path.relative_to(tmp_path / "host").as_posix(): path.read_text() for path in written}
    assert given == host_modules()
    own = {path.relative_to(FOLDER).as_posix() for path in files(FOLDER) if path.suffix == ".js"}
    assert given.keys() == own | {BUILTINS, SHAPES}
    assert given[BUILTINS].startswith("// The builtins, generated from compiler/reference")


def test_the_package_names_the_tools_of_the_toolchain() -> None:
    package = json.loads((FOLDER / "package.json").read_text())
    for name, version in package["devDependencies"].items():
        source = tool_named(name).source
        assert isinstance(source, OwnInstaller)
        assert source.pinned == version


def test_the_host_for_webgpu_is_small() -> None:
    """Comments, blank lines and what is generated apart."""
    assert sum(size.sizes(".", "webgpu").values()) < size.MOST


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("", 0),
        ("const a = 1;\n\nconst b = 2; // both\n", 2),
        ("/** What it is,\n * and why. */\nconst a = 1;\n  // Alone.\n", 1),
        ("f({ /* nothing */ }); /** Next. */\ng();\n", 2),
    ],
)
def test_lines_of_code_are_counted(text: str, count: int) -> None:
    assert size.code_lines(text) == count


def test_lines_have_the_length_of_the_tree() -> None:
    assert not too_long(FOLDER)
