"""What is asked of a downstream compiler, and what it answered."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning"]
Status = Literal["accepted", "rejected", "crashed", "timeout", "missing"]
"""``crashed`` and ``timeout`` speak of the tool, not of the shader; ``missing`` means unchecked."""


@dataclass(frozen=True, slots=True)
class Job:
    """One shader text to be checked by one checker."""

    checker: str
    """A name in ``CHECKERS``."""
    stage: str
    """``vert`` or ``frag``."""
    text: str
    entry: str = "main"
    """The entry point's name. GLSL has only ``main``; Tint checks the module and not one entry."""
    name: str = "shader"
    """What people call this text; used in reports only."""
    flags: tuple[str, ...] = ()
    """More arguments for the tool's command line, e.g. ``-fvk-use-dx-layout``."""


@dataclass(frozen=True, slots=True)
class Message:
    """One complaint of a tool about the emitted text."""

    severity: Severity
    line: int | None
    """1-based line of the emitted text; None when the tool names no place."""
    column: int | None
    text: str
    source: str = ""
    """The file that the line is of, as the tool calls it; by it and the text's line directives,
    one may tell that it is not the text itself."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """A tool's answer to a job."""

    job: Job
    status: Status
    messages: tuple[Message, ...] = ()
    """At least one error when the status is ``rejected``."""
    spirv: bytes | None = None
    """The accepted SPIR-V module, where the checker makes one and it was asked to keep it."""
    log: str = ""
    """All the tool said."""
    disassembly: str | None = None
    """The DXIL as text, with the layout of its constant buffers (``dxc-dxil`` only)."""

    def report(self) -> str:
        """The verdict for people: one line, then a line for each message."""
        headline = f"{self.job.name}: {self.job.checker}: {self.status}"
        return "\n".join([headline, *(f"  {self._place(m)}: {m.text}" for m in self.messages)])

    def _place(self, message: Message) -> str:
        known = [str(part) for part in (message.line, message.column) if part is not None]
        return ":".join([self.job.name, *known, f" {message.severity}"])
