"""The command ``burnish new``: a project that draws materials in a program of one's own."""

from __future__ import annotations

import os
import re
import unicodedata
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
LONGEST = 255
"""The bytes that a name of a file may have on usual systems."""

_ROW = re.compile(r"\| \[[^\[\]]+\]\((?P<host>[^()/]+)/README\.md\) \| (?P<what>[^|]+) \| .+ \|")
_NAME = re.compile(r"[^\W_][\w.-]*")
_DEVICE = re.compile(r"(con|prn|aux|nul|com[1-9]|lpt[1-9])(\..*)?", re.IGNORECASE)
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
    files = contents(wanted, name)
    give_out(
        folder, files, "is there already, and nothing was written",
        "choose another name",
    )  # fmt: skip
    say()
    say(f"What it needs is said in {folder / 'README.md'}. To build and to draw:")
    say(f"  cd {folder}")
    for command in _commands(files["README.md"].decode()):
        say(f"  {command}")


def _folder(name: str) -> Path:
    """The folder of a new project. Raises ``BadParameter`` for a name that cannot be one."""
    if (what := _fault(name)) is not None:
        raise click.BadParameter(
            f"`{name}` {what}: give the name of a new folder in this one, such as `lantern`",
            param_hint="NAME",
        )
    if os.path.lexists(name):
        fail(f"`{name}` is there already, and nothing was written\n  = help: choose another name")
    return Path(name)


def _fault(name: str) -> str | None:
    """Why a name cannot be that of a folder on usual systems; ``None`` if it can."""
    if "/" in name or "\\" in name:
        return "is a path"
    if _NAME.fullmatch(name) is None:
        return "is no name of a folder"
    if _DEVICE.fullmatch(name) is not None:
        return "is a name that Windows keeps for itself"
    if name.endswith("."):
        return "ends in a dot, which Windows leaves out"
    if len(name.encode()) > LONGEST:
        return f"is longer than the {LONGEST} bytes that a name may have"
    return None


def contents(host: str, name: str) -> Mapping[str, bytes]:
    """The files of a project of this name, by their paths: what all hosts draw, and the host's own.

    Pages, packages and programs are called like the project.
    """
    files = {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for folder in (HOSTS / COMMON, HOSTS / host)
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not BUILT & set(path.relative_to(folder).parts)
    }
    ignored = "".join(f"{each}/\n" for each in sorted(BUILT)).encode()
    own = {path: _called(path, content, name) for path, content in files.items()}
    return {**own, ".gitignore": ignored}


def _called(path: str, content: bytes, name: str) -> bytes:
    """The content of a file, in which the project's name stands for the host's."""
    for file, pattern, form in _OF_NAME:
        if path.endswith(file):
            text = form.format(name=name, word=_word(name))
            content = pattern.sub(text.encode(), content)
    return content


_OF_NAME = (
    ("README.md", re.compile(rb"\A# .*"), "# {name}"),
    ("README.md", re.compile(rb"\bbuild/cpp-vulkan\b"), "build/{word}"),
    (".html", re.compile(rb"<title>.*</title>"), "<title>{name}</title>"),
    ("package.json", re.compile(rb'"name": "burnish-\w+"'), '"name": "{word}"'),
    ("CMakeLists.txt", re.compile(rb"\bCppVulkan\b|\bcpp-vulkan\b"), "{word}"),
    ("Cargo.toml", re.compile(rb'\bname = "rust-wgpu"'), 'name = "{word}"'),
    ("Cargo.lock", re.compile(rb'\bname = "rust-wgpu"'), 'name = "{word}"'),
)
"""Where files of hosts have a name that becomes the project's: what they end in, and the text.

``{word}`` is the name as packages and programs may be called.
"""


def _word(name: str) -> str:
    """The name in the letters that npm, Cargo and CMake all take."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode().lower()
    found = re.sub(r"[^a-z0-9_-]+", "-", plain).strip("-_")
    return found if found[:1].isalpha() else f"project-{found}".strip("-")


def _commands(page: str) -> list[str]:
    """The commands that a project's page gives."""
    return [line for block in _COMMANDS.findall(page) for line in block.splitlines() if line]
