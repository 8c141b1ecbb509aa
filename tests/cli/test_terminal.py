"""Characters that a terminal would obey are escaped, whichever command prints them."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from burnish.commands.console import Styled, say
from burnish.commands.terminal import complain, print_output
from burnish.targets.toolchain import tools

from .kit import invoke

EVIL = "a\x1b]0;b\x07\u202ec\x9bd"
"""Sets a window's title, reverses the direction of the text, and begins another command."""
SHOWN = "a<U+001B>]0;b<U+0007><U+202E>c<U+009B>d"


class Terminal(io.TextIOWrapper):
    """A stream that says of itself whether it is a terminal."""

    def __init__(self, is_terminal: bool) -> None:
        super().__init__(io.BytesIO(), "utf-8")
        self._is_terminal = is_terminal

    def isatty(self) -> bool:
        return self._is_terminal

    def written(self) -> str:
        """All that was written so far."""
        self.flush()
        assert isinstance(self.buffer, io.BytesIO)
        return self.buffer.getvalue().decode()


def printing(patch: pytest.MonkeyPatch, is_terminal: bool) -> Terminal:
    """The stream that takes the place of standard output."""
    stream = Terminal(is_terminal)
    patch.setattr(sys, "stdout", stream)
    patch.delenv("NO_COLOR", raising=False)
    return stream


@pytest.mark.parametrize("is_terminal", [True, False])
def test_lines_for_people(is_terminal: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    output = printing(monkeypatch, is_terminal)
    say(f"{EVIL}\n", Styled(EVIL, "red"), "!")
    colored = f"\x1b[31m{SHOWN}\x1b[0m" if is_terminal else SHOWN
    assert output.written() == f"{SHOWN}<U+000A>{colored}!\n"


@pytest.mark.parametrize("is_terminal", [True, False])
def test_data_stay_as_they_are_but_on_a_terminal(
    is_terminal: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = printing(monkeypatch, is_terminal)
    print_output(f"one {EVIL}\n\ttwo\n")
    assert output.written() == f"one {SHOWN if is_terminal else EVIL}\n\ttwo\n"


def test_errors_of_the_system(capsys: pytest.CaptureFixture[str]) -> None:
    complain(f"error: `{EVIL}`: no")
    assert capsys.readouterr().err == f"error: `{SHOWN}`: no\n"


@pytest.mark.parametrize(
    "words",
    [
        (EVIL,), ("check", EVIL), ("compile", EVIL, "-o", "x"), ("explain", EVIL),
        ("render", EVIL, "-o", "x.png"), ("render", "m.burnish", "-o", EVIL),
        ("render", "m.burnish", "-o", "x.png", "--on", EVIL), ("conform", EVIL),
        ("conform", "m.burnish", "--routes", EVIL), ("graph", EVIL), ("gallery", EVIL, "-o", "x"),
        ("view", EVIL), ("graph", "m.burnish", "-o", EVIL), ("check", f"--{EVIL}"),
        ("render", "m.burnish", "-o", "x.png", "--set", f"b=1{EVIL}"),
        ("render", "m.burnish", "-o", "x.png", "--set", EVIL),
    ],
    ids=ascii,
)  # fmt: skip
def test_messages_quote_words_of_the_command_line(
    words: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A shell may have filled them in: they are names of files."""
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text("material M { param b : float = 1\n color = vec3(b) }\n")
    result = invoke(*words)
    assert result.exit_code in (1, 2)
    assert "<U+001B>" in result.stderr or "\\x1b" in result.stderr
    assert not {"\x1b", "\x07", "\u202e", "\x9b"} & set(result.output)


TWO = "a\nerror[B9999]: fake"
"""A name that looks as if there were another message."""


@pytest.mark.parametrize(
    "words",
    [
        ("check", TWO), ("render", TWO, "-o", "x.png"), ("render", "m.burnish", "-o", TWO),
        ("render", "m.burnish", "-o", "x.png", "--on", TWO), ("check", f"--{TWO}"),
        ("render", "m.burnish", "-o", "x.png", "--set", TWO), ("gallery", TWO, "-o", "x"),
        ("explain", TWO), (TWO,),
    ],
    ids=ascii,
)  # fmt: skip
def test_a_name_does_not_look_like_another_message(
    words: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text("material M { param b : float = 1\n color = vec3(b) }\n")
    result = invoke(*words)
    assert result.exit_code in (1, 2)
    assert "fake" in result.stderr
    assert not [line for line in result.stderr.splitlines() if line.startswith("error[B9999]")]


def test_the_help_of_an_empty_command_line_is_as_it_is() -> None:
    shown = invoke().stderr
    assert shown.startswith("Usage: ")
    assert "\n\nOptions:\n" in shown
    assert "<U+" not in shown


def test_further_lines_of_a_message_are_indented(capsys: pytest.CaptureFixture[str]) -> None:
    complain("error: one\n  two\nthree\n\n  four\r")
    assert capsys.readouterr().err == ("error: one\n  two<U+000A>three<U+000A>\n  four<U+000D>\n")


def test_names_of_files_in_what_is_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path(f"{EVIL}.burnish").write_text("material M { x = sin(uv.x)\n color = vec3(x * x) }\n")
    for form in ("text", "dot", "svg"):
        printed = invoke("graph", f"{EVIL}.burnish", "--format", form).stdout
        assert "U+001B" in printed
        assert not {"\x1b", "\x07", "\u202e", "\x9b"} & set(printed), form
    assert SHOWN in invoke("render", f"{EVIL}.burnish", "-o", f"{EVIL}.png", "--size", 4).stdout
    assert Path(f"{EVIL}.png").exists()


def test_what_tools_say(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`doctor` shows versions as the tools tell them."""
    tool = tools.TOOLS[0]
    states = {tool.name: tools.ToolState(tool, (tmp_path / EVIL,), EVIL, None)}
    every = {name: states.get(name, state) for name, state in tools.inspect_all().items()}
    monkeypatch.setattr(tools, "inspect_all", lambda: every)
    printed = invoke("doctor").stdout
    assert printed.count(SHOWN) == 2, "of its version and its path"
    assert "\x1b" not in printed and "\x07" not in printed
