"""Checks shader texts with the real downstream compilers: DXC, glslang, naga, Tint, clang.

``compile --validate``, ``conform``, ``doctor`` and the tests use it. Plain compiling never loads
it.
"""

from .checkers import CHECKERS, Checker, checkers_needing
from .dxil_offsets import block_offsets_dxil
from .job import Job, Message, Status, Verdict
from .offsets import Offsets, block_offsets_spirv
from .spirv import SpirvError, count_instructions, optimise
from .toolchain import Toolchain
from .tools import TOOLS, Tool, ToolState, inspect

__all__ = [
    "CHECKERS",
    "TOOLS",
    "Checker",
    "Job",
    "Message",
    "Offsets",
    "SpirvError",
    "Status",
    "Tool",
    "ToolState",
    "Toolchain",
    "Verdict",
    "block_offsets_dxil",
    "block_offsets_spirv",
    "checkers_needing",
    "count_instructions",
    "inspect",
    "optimise",
]
