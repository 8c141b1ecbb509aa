"""Describes Python as a language of hosts."""

from __future__ import annotations

import builtins
import keyword
from pathlib import Path

from ..folding import Style
from ..host_language import HostLanguage
from ..naming import pascal, screaming, snake
from ..spelling import Manner
from .printer import PythonPrinter
from .texts import texts

_OF_SKELETON = (
    "ABC", "Any", "Array", "Attachment", "Block", "BlockType", "Blocks", "Bound",
    "Callable", "ClassVar", "Columns", "Each", "Elements", "Field", "Frame", "FrameBuffer",
    "FrameHost", "FrameTexture", "Generic", "Iterable", "Iterator", "Kept", "Kind",
    "LAYOUT_ID", "Lanes", "MATERIALS", "Mapping", "Material", "NamedTuple", "Number",
    "Output", "Part", "Pass", "Profile", "ROLES", "SIZE", "Self", "Sequence", "Source", "T",
    "Text", "Texture", "TypeVar", "Use", "VertexInput", "WgpuFrameHost", "abstractmethod",
    "annotations", "bind_group_layouts", "bind_groups", "block", "blocks", "check",
    "compute_pipeline", "enum", "math", "memory", "overload", "render_pipeline", "reset", "self",
    "struct", "uniform_buffers", "vertex_buffers",
)  # fmt: skip

LANGUAGE = HostLanguage(
    name="python",
    title="Python",
    extension="py",
    skeleton=Path(__file__).with_name("binding.py.j2"),
    printer=PythonPrinter,
    texts=texts,
    style=Style(comments=("#",), docstrings=True, in_parentheses=True, last_comma=True),
    manner=Manner(
        reserved=frozenset((*keyword.kwlist, *dir(builtins), *_OF_SKELETON)),
        type_case=pascal,
        function_case=snake,
        value_case=snake,
        constant_case=screaming,
    ),
)
