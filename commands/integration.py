"""The command ``burnish integration``: what other build systems need, which comes with Burnish."""

from __future__ import annotations

import re
from pathlib import Path

import click

from .console import say
from .giving_out import give_out
from .options import answer_option
from .shipped import DOCS, INTEGRATIONS, chosen, say_groups

_TITLES = {"cmake": "CMake", "rust": "Rust", "vite": "Vite"}
"""The heading in the page about integrations, by the name of the folder of each."""
WHAT = {
    "cmake": "a package for find_package, with burnish_add_materials()",
    "rust": "a crate for build.rs",
    "vite": "a plugin for Vite, which imports materials",
}


@click.command()
@click.argument("name", required=False, metavar="[NAME]")
@click.option(
    "-o", "out", metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path),
    help="Write a copy into this folder, for projects that keep one.",
)  # fmt: skip
@click.option("--path", "as_path", is_flag=True, help="Print the folder where it is.")
@answer_option
def integration(name: str | None, out: Path | None, as_path: bool) -> None:
    """List what Burnish brings for build systems, or tell how NAME is used.

    The files are used where they are, which `--path` prints, or as a copy in a project.

    \b
    Example:
        burnish integration
        burnish integration cmake
        cmake -B build -DBurnish_ROOT="$(burnish integration cmake --path)"
        burnish integration rust -o burnish-build
    """
    if name is None:
        _list(as_path)
        return
    wanted = chosen("integration", name, WHAT, "")
    folder = INTEGRATIONS / wanted
    if as_path:
        say(str(folder))
    elif out is not None:
        contents = {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in sorted(folder.rglob("*"))
            if path.is_file()
        }
        give_out(
            out, contents, "has other contents, and nothing was written",
            "move it away, or name another folder: `-o FOLDER`",
        )  # fmt: skip
    else:
        for line in _section(_TITLES[wanted]):
            say(line)


def _list(as_path: bool) -> None:
    if as_path:
        say(str(INTEGRATIONS))
        return
    say("How each is used is told by `burnish integration NAME`.")
    say_groups({"Build systems": WHAT})
    say()
    say("Hooks for pre-commit and an action for GitHub are in Burnish's repository itself:")
    say("`burnish docs integrations` has all of them.")


def _section(title: str) -> list[str]:
    """The lines of a section of the page about integrations, without its heading."""
    page = (DOCS / "integrations.md").read_text(encoding="utf-8")
    (found,) = re.findall(rf"^## {title}\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL)
    return str(found).strip().splitlines()
