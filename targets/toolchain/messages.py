"""Parses the output of each tool into ``Message`` records."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from .job import Message, Severity

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")

_GLSLANG = re.compile(r"(ERROR|WARNING): (?:([^:\s]+):(\d+): )?(.*)")
_GLSLANG_HLSL = re.compile(r"(\S.*)\((\d+)\): error at column (\d+), (.*)")
_GLSLANG_FATAL = "Entry point not found"
"""The warning with which glslang compiles nothing: for HLSL, it only warns."""
_GLSLANG_NOISE = re.compile(
    r"\d+ compilation errors\.|'' : compilation terminated|'image_format' : unrecognized attribute"
)

_CLANG = re.compile(r"(?:(\S.*?):(\d+):(?:(\d+):)? )?(?:fatal )?(error|warning): (.*)")
_DXC_NOISE = re.compile(
    r"DXIL\.dll not found|validation errors$|unknown attribute 'format_\w+' ignored"
)
"""Messages that mean nothing here. An image has two attributes with its format, one that DXC reads
and one that glslang reads."""

_NAGA_HEAD = re.compile(r"(error|warning): (.*)")
_NAGA_PLACE = re.compile(r"\s*┌─ .*:(\d+):(\d+)$")
_NAGA_CAUSE = re.compile(r"\s*= (.*)")


def read_glslang(log: str) -> tuple[Message, ...]:
    """Parse ``ERROR: 0:12: 'x' : undeclared identifier``; glslang has columns only for HLSL."""
    return tuple(_glslang_messages(log))


def _glslang_messages(log: str) -> Iterator[Message]:
    for line in log.splitlines():
        if found := _GLSLANG_HLSL.match(line):
            place = int(found[2]), int(found[3])
            yield Message("error", *place, found[4].strip(), found[1])
        elif found := _GLSLANG.match(line):
            severity, source, number, text = found.groups()
            fatal = severity == "ERROR" or _GLSLANG_FATAL in text
            if not _GLSLANG_NOISE.match(text):
                where = _number(number), None
                yield Message(_severity(fatal), *where, text.strip(), source or "")


def read_dxc(log: str) -> tuple[Message, ...]:
    """Parse the output of DXC, which is based on clang; its DXIL validator has no columns.

    The warning that there is no DXIL.dll is left out: it means that nothing is signed, which is not
    an error of the shader. The validator itself is part of the library and runs. Messages about
    attributes for glslang are left out as well.
    """
    return tuple(each for each in read_clang(log) if not _DXC_NOISE.match(each.text))


def read_clang(log: str) -> tuple[Message, ...]:
    """Parse ``hlsl.hlsl:3:5: error: ...``, as clang prints it."""
    return tuple(
        Message(
            severity=_severity(found[4] == "error"),
            line=_number(found[2]),
            column=_number(found[3]),
            text=found[5].strip(),
            source=found[1] or "",
        )
        for line in log.splitlines()
        if (found := _CLANG.match(line))
    )


def read_naga(log: str) -> tuple[Message, ...]:
    """Parse an ``error:`` line, then the place in a box drawn below it, then the cause."""
    messages: list[Message] = []
    for line in _COLOUR.sub("", log).splitlines():
        if found := _NAGA_HEAD.match(line):
            messages.append(Message(_severity(found[1] == "error"), None, None, found[2].strip()))
        elif messages:
            messages[-1] = _with_naga_detail(messages[-1], line)
    return tuple(messages)


def _with_naga_detail(message: Message, line: str) -> Message:
    if message.line is None and (found := _NAGA_PLACE.match(line)):
        return replace(message, line=int(found[1]), column=int(found[2]))
    if found := _NAGA_CAUSE.match(line):
        return replace(message, text=f"{message.text}: {found[1].strip()}")
    return message


def read_tint(rows: Iterable[Mapping[str, Any]]) -> tuple[Message, ...]:
    """Convert the rows that ``tint_worker.mjs`` sends; notes are added to what they explain."""
    messages: list[Message] = []
    for row in rows:
        line, column = row["line"] or None, row["column"] or None
        if row["type"] in ("error", "warning"):
            messages.append(Message(_severity(row["type"] == "error"), line, column, row["text"]))
        elif messages:
            note = f"{messages[-1].text}; {line}:{column}: {row['text']}"
            messages[-1] = replace(messages[-1], text=note)
    return tuple(messages)


def _severity(fatal: bool) -> Severity:
    return "error" if fatal else "warning"


def _number(digits: str | None) -> int | None:
    return int(digits) if digits else None
