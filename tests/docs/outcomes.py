"""What the compiler says of a snippet, and how that is shown below it."""

from __future__ import annotations

import re
from pathlib import Path

import burnish
from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.compiler.diagnostics.render import render_all
from burnish.targets.selection import DEFAULT

from .kit import EXAMPLES, Block, blocks

HEAD = "import std.lights\nimport std.terms\nmaterial Sample {\n"
MATERIAL = re.compile(r"^material ", re.MULTILINE)


def whole(block: Block) -> str:
    """The file that a block stands for."""
    if "in-material" in block.marks:
        return f"{HEAD}{block.text}}}\n"
    if MATERIAL.search(block.text) or block.value("file") or block.value("error"):
        return block.text
    return f"{block.text}\nmaterial Sample {{}}\n"


def declare_files(block: Block, folder: Path) -> None:
    """Writes the files that a page declares before a block."""
    for other in blocks(block.page, "burnish"):
        if (name := other.value("file")) and other.line < block.line:
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(whole(other), encoding="utf-8")


def outcome(block: Block, folder: Path) -> tuple[Diagnostic, ...]:
    """The diagnostics of a block, compiled beside the files that its page declares before it."""
    declare_files(block, folder)
    path = folder / "sample.burnish"
    path.write_text(whole(block), encoding="utf-8")
    rig, pass_ = block.value("rig"), block.value("pass")
    targets = block.value("targets") or DEFAULT
    try:
        result = burnish.compile(path, targets, search_path=[EXAMPLES], rig=rig, pass_=pass_)
    except burnish.CompileError as error:
        return error.diagnostics
    assert result.materials or block.value("file")
    return result.diagnostics


def source_of(message: Block) -> Block:
    """The snippet of which a message is shown: the last wrong one before it, of the same code."""
    above = [b for b in blocks(message.page, "burnish") if b.value("error")]
    source = [block for block in above if block.line < message.line][-1]
    assert source.value("error") == message.value("from")
    return source


def told(block: Block, folder: Path) -> str:
    """What people see of a wrong snippet."""
    name = block.value("as") or "plastic"
    return render_all(outcome(block, folder)).replace(f"{folder}/sample", name) + "\n"
