"""The command ``burnish new``: a project that draws materials in a program of one's own."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

import click

from .console import say
from .failures import fail
from .giving_out import give_out
from .options import answer_option
from .shipped import EXAMPLES, chosen, say_groups

HOSTS = EXAMPLES / "hosts"
COMMON = "common"
"""The folder of what all hosts draw."""
BUILT = frozenset(("__pycache__", "build", "dist", "node_modules", "target"))
"""Folders that builds make, which are no part of a project."""

_ROW = re.compile(r"\| \[[^\[\]]+\]\((?P<host>[^()/]+)/README\.md\) \| (?P<what>[^|]+) \| .+ \|")
_NAME = re.compile(r"[^\W_][\w.-]*")
_COMMANDS = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)


def hosts() -> dict[str, str]:
    """The hosts, each with its description, as the page of their folder lists them."""
    page = (HOSTS / "README.md").read_text(encoding="utf-8")
    rows = map(_ROW.fullmatch, page.splitlines())
    return {row["host"]: row["what"].strip() for row in rows if row is not None}


@click.command()
@click.argument("name", required=False, metavar="[NAME]")
@click.option(
    "--host", metavar="HOST", help=f"The program's language and library: {', '.join(hosts())}."
)
@answer_option
def new(name: str | None, host: str | None) -> None:
    """Make a project that draws, in a new folder NAME; without NAME, list the hosts.

    A project has three sources of Burnish, a scene, and a small program that draws them by the
    binding that `burnish bind` writes in its language. Its README.md says what it needs, and has
    the commands that build and draw. Nothing is written if the folder is there already.

    \b
    Example:
        burnish new
        burnish new lantern --host wgpu-py
    """
    if name is None:
        say("Hosts, of each of which `burnish new NAME --host HOST` makes a project.")
        say_groups({"Hosts": hosts()})
        return
    if host is None:
        raise click.UsageError(f"name a host: `--host` with one of {', '.join(hosts())}")
    wanted = chosen("host", host, hosts(), "")
    folder = _folder(name)
    give_out(
        folder, contents(wanted), "is there already, and nothing was written",
        "choose another name",
    )  # fmt: skip
    say()
    say(f"What it needs is said in {folder / 'README.md'}. To build and to draw:")
    say(f"  cd {folder}")
    for command in _commands(wanted):
        say(f"  {command}")


def _folder(name: str) -> Path:
    """The folder of a new project. Raises ``BadParameter`` for a name that cannot be one."""
    if _NAME.fullmatch(name) is None:
        what = "is a path" if "/" in name or "\\" in name else "is no name of a folder"
        raise click.BadParameter(
            f"`{name}` {what}: give the name of a new folder in this one, such as `lantern`",
            param_hint="NAME",
        )
    if os.path.lexists(name):
        fail(f"`{name}` is there already, and nothing was written\n  = help: choose another name")
    return Path(name)


def contents(host: str) -> Mapping[str, bytes]:
    """The files of a project by their paths: what all hosts draw, and the host's own."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for folder in (HOSTS / COMMON, HOSTS / host)
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not BUILT & set(path.relative_to(folder).parts)
    }


def _commands(host: str) -> list[str]:
    """The commands that the host's page gives."""
    page = (HOSTS / host / "README.md").read_text(encoding="utf-8")
    return [line for block in _COMMANDS.findall(page) for line in block.splitlines() if line]
