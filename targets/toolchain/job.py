"""The types of a request to a downstream compiler and of its answer, which all checkers share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning"]
Status = Literal["accepted", "rejected", "crashed", "timeout", "missing"]
"""``crashed`` and ``timeout`` concern the tool, not the shader; ``missing`` means not checked."""


@dataclass(frozen=True, slots=True)
class Job:
    """One shader text to be checked by one checker."""

    checker: str
    """A name in ``CHECKERS``."""
    stage: str
    """``vert`` or ``frag``."""
    text: str
    entry: str = "main"
    """The entry point's name. GLSL only has ``main``; Tint checks the whole module."""
    name: str = "shader"
    """The name of this text in reports."""
    flags: tuple[str, ...] = ()
    """Further command-line arguments for the tool, such as ``-fvk-use-dx-layout``."""


@dataclass(frozen=True, slots=True)
class Message:
    """One error or warning of a tool about the emitted text."""

    severity: Severity
    line: int | None
    """The line of the emitted text, counted from 1; ``None`` if the tool names no place."""
    column: int | None
    text: str
    source: str = ""
    """The tool's name for the file of the line. Because of line directives, it may be another file
    than the emitted text.
    """


@dataclass(frozen=True, slots=True)
class Verdict:
    """A tool's answer to a job."""

    job: Job
    status: Status
    messages: tuple[Message, ...] = ()
    """Contains an error if the status is ``rejected``."""
    spirv: bytes | None = None
    """The accepted SPIR-V module, if the checker makes one and was asked to keep it."""
    log: str = ""
    """The complete output of the tool."""
    dxil: bytes | None = None
    """The accepted DXIL, likewise."""
    disassembly: str | None = None
    """The DXIL as text, which contains the layout of its constant buffers (``dxc-dxil`` only)."""

    def report(self) -> str:
        """The verdict for people: one line, then a line for each message."""
        headline = f"{self.job.name}: {self.job.checker}: {self.status}"
        return "\n".join([headline, *(f"  {self._place(m)}: {m.text}" for m in self.messages)])

    def _place(self, message: Message) -> str:
        known = [str(part) for part in (message.line, message.column) if part is not None]
        return ":".join([self.job.name, *known, f" {message.severity}"])
