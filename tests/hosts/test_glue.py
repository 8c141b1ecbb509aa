"""The glue of all hosts: what stands between a binding and the calls of an API is short.

The page "Adopt it" has the number of lines of each.
"""

from __future__ import annotations

from typing import NamedTuple

import pytest

from burnish.commands.new import hosts

from .projects import ENGINE, HOSTS, count, glue

PAGE = HOSTS.parents[1] / "docs" / "adopt.md"
PARTS = ("materials", "frames of passes")
"""What each pair of marks of a program is about, in their order."""


class Program(NamedTuple):
    """The file of a host that has its glue."""

    file: str
    comments: tuple[str, ...] = ("//", "/**")
    most: int = 15


PROGRAMS = {
    "wgpu-py": Program("draw.py", ("#", '"""')),
    "moderngl": Program("draw.py", ("#", '"""')),
    "webgpu": Program("main.ts"),
    "webgl2": Program("main.ts"),
    "cpp-vulkan": Program("main.cpp"),
    "rust-wgpu": Program("src/main.rs"),
    # three.js has no bindings of its own to fill: each value of three scenes is set here.
    "three": Program("draw.js", most=25),
}


def test_each_host_has_glue() -> None:
    assert list(PROGRAMS) == list(hosts())


@pytest.mark.parametrize("host", PROGRAMS)
def test_little_stands_between_a_binding_and_an_api(host: str) -> None:
    program = PROGRAMS[host]
    text = (HOSTS / host / program.file).read_text(encoding="utf-8")
    lines = glue(text, program.comments)
    assert lines
    assert all(5 < number <= program.most for number in lines)
    page = PAGE.read_text(encoding="utf-8")
    for what, number in zip(PARTS, lines, strict=False):
        assert f"| glue beside the binding, {what}: {host} | {number} lines |" in page
    for part in ENGINE.findall(text):
        what = "an engine for frames of passes where the binding brings none"
        assert f"| {what}: {host} | {count(part, program.comments)} lines |" in page
