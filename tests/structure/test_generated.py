"""Results computed when the package was built are used, unless their sources have changed."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest

from ..suite.package import copy_package
from ..suite.processes import run

COMPILE = """
import sys
sys.meta_path[:] = (finder for finder in sys.meta_path if "Editable" not in repr(finder))
import burnish
(material,) = burnish.compile("material M { color = vec3(0.5) }", ("wgsl",)).materials
print(material.text("wgsl", "fragment"))
print("jinja2" in sys.modules, "lark" in sys.modules)
"""


class Copy:
    """A copy of the package that a test may change."""

    def __init__(self, folder: Path) -> None:
        self.root = copy_package(folder / "burnish", "generated")

    def change(self, name: str, old: str, new: str) -> None:
        """Change a file as a developer does, but within the second in which it was written."""
        path = self.root / name
        status = path.stat()
        text = path.read_text("utf-8")
        assert old in text
        path.write_text(text.replace(old, new), "utf-8")
        os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))

    def run(self, *arguments: str) -> str:
        """The output of a fresh process that imports this copy."""
        environment = os.environ | {"PYTHONPATH": str(self.root.parent)}
        return run([sys.executable, "-P", *arguments], env=environment, check=True).stdout

    def compiled(self) -> tuple[str, bool, bool]:
        """A shader that is compiled here, and whether Jinja and Lark were needed for it."""
        *lines, loaded = self.run("-c", COMPILE).splitlines()
        jinja, lark = (word == "True" for word in loaded.split())
        return "\n".join(lines), jinja, lark


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    """A copy in which everything is generated, as pytest does so before all tests."""
    return Copy(tmp_path)


def test_neither_jinja_nor_lark_is_needed(copy: Copy) -> None:
    text, jinja, lark = copy.compiled()
    assert "vec4f(0.5, 0.5, 0.5, 1.0)" in text
    assert not jinja
    assert not lark


@pytest.mark.parametrize(
    ("name", "old", "new", "shown", "jinja", "lark"),
    [
        ("targets/wgsl/shader.wgsl.j2", "@{{ entry", "// new\n@{{ entry", "// new", True, False),
        ("targets/emit/skeleton.j2", "\n{% for line in file", "\n// new\n{% for line in file",
         "// new", True, False),
        ("targets/emit/skeleton_compiler.py", "''.join(out)", "''.join(out) + '// new'",
         "// new", True, False),
        ("stdlib/prelude.burnish", "alpha : float = 1", "alpha : float = 0.25",
         "vec4f(0.5, 0.5, 0.5, 0.25)", False, False),
        ("compiler/syntax/builder.py", "text = token.text", "text = token.text.replace('1', '3')",
         "vec4f(0.5, 0.5, 0.5, 3.0)", False, False),
        ("compiler/syntax/burnish.lark", '!folding: "sum"', '!folding: "total" | "sum"',
         "vec4f(0.5, 0.5, 0.5, 1.0)", False, True),
        ("compiler/syntax/lalr_tables.py", "lexer=\"basic\",", "lexer='basic',",
         "vec4f(0.5, 0.5, 0.5, 1.0)", False, True),
    ],
)  # fmt: skip
def test_what_has_changed_is_computed_again(
    copy: Copy, name: str, old: str, new: str, shown: str, jinja: bool, lark: bool
) -> None:
    copy.change(name, old, new)
    text, *needed = copy.compiled()
    assert shown in text
    assert needed == [jinja, lark]
    copy.run("-m", "burnish.generate")
    assert copy.compiled() == (text, False, False)


TABLE = """
from burnish.compiler.precomputed import precomputed
from burnish.targets.web_host.serving.builtin_table import builtins_module, module_to_generate
(key,) = module_to_generate()
print(builtins_module())
print(precomputed("builtin_table", key) is not None)
"""


def test_the_table_of_builtins_follows_the_reference(copy: Copy) -> None:
    assert copy.run("-c", TABLE).endswith("\nTrue\n")
    copy.change("compiler/reference/floats.py", "clamp(xp, x, 0.0, 1.0)", "clamp(xp, x, 0.0, 12.0)")
    made = copy.run("-c", TABLE)
    assert '  "saturate float": (x) => Math.min(Math.max(x, 0), 12),\n' in made
    assert made.endswith("\nFalse\n")
    copy.run("-m", "burnish.generate")
    assert copy.run("-c", TABLE) == made.replace("\nFalse\n", "\nTrue\n")


def test_editors_get_the_types_of_the_host(copy: Copy) -> None:
    types = copy.root / "targets" / "web_host" / "generated" / "documents.d.ts"
    assert "export interface FramePlan {\n" in types.read_text("utf-8")
    types.unlink()
    copy.run("-m", "burnish.generate")
    assert types.is_file()


def test_nothing_is_generated_twice(copy: Copy) -> None:
    paths = sorted((copy.root / "generated").glob("*.py"))
    before = [path.stat().st_mtime_ns for path in paths]
    copy.run("-m", "burnish.generate")
    assert [path.stat().st_mtime_ns for path in paths] == before


def test_everything_works_with_nothing_generated(copy: Copy) -> None:
    expected = copy.compiled()[0]
    shutil.rmtree(copy.root / "generated")
    assert copy.compiled() == (expected, True, True)
    assert not (copy.root / "generated").exists()
