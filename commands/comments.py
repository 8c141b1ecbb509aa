"""Reads the comment about a whole file: its lines that begin with ``//!``.

Its paragraphs stand on the page of the file. An indented one is a command, and if it is a
``burnish render`` of this very file, it says how the pictures of the page are drawn::

    //! Cloth in the wind.
    //!
    //!     burnish render cloth.burnish -o cloth.png --steps 60 --again now=after

As in a shell, a line that ends with a backslash continues on the next. Such a command is not run,
since the file may come from anybody and the page may be published. ``FOLLOWED`` lists the options
that a file may ask for; each is read by itself, with the rules that ``render`` has for it. Whoever
asks for something else is drawn plainly, with a note. The gallery calls ``asked``, and so does
``as_asked.py`` for ``render`` and ``view``.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path, PurePath
from typing import Any, NamedTuple

import click

from ..targets.runner.textures.kinds import without_prefix
from .catalogue import is_shown

_MARK = "//!"
_INDENT = " " * 5
"""The indent of a command, after the mark."""
_BEGINNING = "burnish render "
LONGEST = 4000
"""The most letters of a command that is followed."""
MOST_WORK = 2**26
"""The most pixels that a file may ask for in all steps of all its frames: 64 pictures of 1024 ×
1024."""
_LEAST_SIZE = 256
"""The least pixels of a side for this count, as steps of kernels take no less time for smaller
pictures."""


class Paragraph(NamedTuple):
    """A part of the comment."""

    text: str
    is_command: bool


class Asked(NamedTuple):
    """The command that a file's comment asks for."""

    words: Sequence[str]
    """The words behind ``burnish render``; none if there is no command that is followed."""
    options: Mapping[str, Any]
    """Values of options, by the names that ``render`` has for them."""
    note: str
    """The reason why a command is not followed; empty if it is."""


NOTHING = Asked((), {}, "")


class _NotFollowedError(Exception):
    """Stops reading a command; the text is the end of a sentence about the comment."""


def paragraphs(source: str) -> list[Paragraph]:
    """The comment about a whole file, in the order of its lines."""
    found: list[Paragraph] = []
    lines: list[str] = []

    def end() -> None:
        if lines:
            found.append(Paragraph(" ".join(lines), is_command=False))
            lines.clear()

    for line in source.splitlines():
        if not line.startswith(_MARK):
            continue
        text = line.removeprefix(_MARK)
        if text.startswith(_INDENT) or not text.strip():
            end()
        if not text.strip():
            continue
        if text.startswith(_INDENT):
            before = found.pop().text[:-1] if found and _continues(found[-1]) else ""
            found.append(Paragraph(before + text.strip(), is_command=True))
        else:
            lines.append(text.strip())
    end()
    return found


def _continues(paragraph: Paragraph) -> bool:
    return paragraph.is_command and paragraph.text.endswith("\\")


def asked(source: str, name: str, root: Path, size: int, command: click.Command) -> Asked:
    """The command in the comment of a file called ``name`` in the folder ``root``.

    Pictures have ``size`` pixels on a side. ``command`` is ``burnish render``, whose options they
    are.
    """
    try:
        words = _command(source, name)
        if not words:
            return NOTHING
        options = _options(words[1:], root, command)
        _check_work(options, size)
        return Asked(words, options, "")
    except _NotFollowedError as reason:
        said = f"the comment of the file {reason}; it is drawn without that"
        return NOTHING._replace(note=said)


def files_of(value: str, root: Path) -> Iterator[Path]:
    """All existing files that the value of a parameter, a texture or a buffer may name.

    ``Instance.set_text`` takes the value as one path, or as several with commas between them.
    """
    plain = without_prefix(value.strip())
    parts = dict.fromkeys((value, plain, *map(str.strip, plain.split(","))))
    for path in (root / part for part in parts if part):
        try:
            path.lstat()
        except (OSError, ValueError):
            continue
        yield path


def _command(source: str, name: str) -> list[str]:
    """The words of the first command that draws this file; none if there is no command at all."""
    other = ""
    for words in _commands(source):
        if words[0] == name:
            return words
        other = other or words[0]
    if other:
        raise _NotFollowedError(f"draws `{other}`, and the file is `{name}`")
    return []


def _commands(source: str) -> Iterator[list[str]]:
    """The words behind ``burnish render`` of each command. The first word is the file."""
    for text, is_command in paragraphs(source):
        if not is_command or not text.startswith(_BEGINNING):
            continue
        if len(text) > LONGEST:
            raise _NotFollowedError(f"has a command of over {LONGEST} letters")
        try:
            words = shlex.split(text.removeprefix(_BEGINNING))
        except ValueError as error:
            reason = str(error).lower()
            raise _NotFollowedError(f"has a command that cannot be read ({reason})") from None
        if words:
            yield words


def _options(words: Sequence[str], root: Path, command: click.Command) -> dict[str, Any]:
    """The values of all options of a command."""
    given: dict[click.Option, list[str]] = {}
    rest = iter(words)
    known = {
        name: option for option in command.params if isinstance(option, click.Option)
        for name in option.opts
    }  # fmt: skip
    for word in rest:
        name, equals, value = word.partition("=") if word.startswith("--") else (word, "", "")
        option = known.get(name)
        if option is None or name not in FOLLOWED:
            raise _NotFollowedError(f"asks for `{word}`, which is not followed")
        for following in islice(rest, 0 if equals else 1):
            value = following
        if reason := FOLLOWED[name](value, root):
            raise _NotFollowedError(f"asks for `{name} {value}`: {reason}")
        given.setdefault(option, []).append(value)
    context = click.Context(command)
    values: dict[str, Any] = {}
    try:
        for option, texts in given.items():
            if option.name is not None and option.name != "output":
                text = texts if option.multiple else texts[-1]
                values[option.name] = option.process_value(context, text)
    except click.ClickException as error:
        raise _NotFollowedError(f"has a command with a mistake ({error.message})") from None
    return values


def _check_work(options: Mapping[str, Any], size: int) -> None:
    """Refuse options that would take too long."""
    frames, steps = options.get("frames", 1), options.get("steps", 1)
    most = max(MOST_WORK // max(size, _LEAST_SIZE) ** 2, 1)
    if frames * steps > most:
        raise _NotFollowedError(
            f"asks for {frames} frames of {steps} steps: of pictures of this size, "
            f"up to {most} steps in all are taken"
        )


def _anything(_value: str, _root: Path) -> str:
    return ""


def _at_most(most: int) -> Callable[[str, Path], str]:
    def check(value: str, _root: Path) -> str:
        few = len(value) < 9 and value.isdecimal() and int(value) <= most
        return "" if few else f"up to {most} are taken"

    return check


def _plain_name(value: str, _root: Path) -> str:
    """The reason to refuse a name that is not a plain file name; empty if it is one.

    The gallery names its own files; but people may copy the command from the page.
    """
    is_plain = PurePath(value).name == value and value[:1] not in ("", ".", "-")
    return "" if is_plain else "a picture is written beside the file"


def _own_files(value: str, root: Path) -> str:
    """Pictures, and elements of buffers, only of the folder, by relative paths."""
    _name, _equals, text = value.partition("=")
    paths = list(files_of(text, root))
    if any(PurePath(part.strip()).is_absolute() for part in without_prefix(text).split(",")):
        return "files are taken by relative paths"
    if not all(is_shown(path, root) for path in paths):
        return "only files of its own folder are taken"
    return ""


def _computed_environment(value: str, _root: Path) -> str:
    from ..targets.runner.textures.environments import FORMULAS

    return "" if value in (*FORMULAS, "none") else "files are not taken"


FOLLOWED: Mapping[str, Callable[[str, Path], str]] = {
    "-o": _plain_name,
    "--output": _plain_name,
    "--mesh": _anything,
    "--instances": _at_most(1000),
    "--set": _own_files,
    "--steps": _at_most(1000),
    "--again": _anything,
    "--background": _anything,
    "--environment": _computed_environment,
    "--eye": _anything,
    "--exposure": _anything,
    "--look-at": _anything,
    "--samples": _anything,
    "--tone": _anything,
    "--turn": _anything,
    "--frames": _at_most(60),
    "--target": _anything,
    "--material": _anything,
    "--rig": _anything,
    "--pass": _anything,
}
"""The options that a file may ask for. Each function returns why a value is not followed, or
nothing; the option itself checks the value."""
