"""Describes C as a language of hosts."""

from __future__ import annotations

from pathlib import Path

from ..c_family.printer import LIBRARY
from ..folding import Style
from ..host_language import HostLanguage
from ..naming import pascal, snake
from ..spelling import Manner
from .printer import CPrinter
from .texts import texts

_KEYWORDS = """
    alignas alignof asm auto bool break case char const continue default do double else enum extern
    false float for goto if inline int long register restrict return short signed sizeof static
    static_assert struct switch thread_local true typedef union unsigned void volatile while
"""
_OF_CPP = """
    and and_eq bitand bitor catch class compl concept constexpr delete explicit export friend
    mutable namespace new not not_eq operator or or_eq private protected public requires template
    this throw try typeid typename using virtual xor xor_eq
"""
"""Words of C++, whose programs include headers of C, too."""
_OF_HEADERS = """
    NULL assert count errno far first int32_t int64_t linux max min near offsetof size_t uint32_t
    uint64_t unix y0 y1 yn j0 j1 jn burnish
"""
"""Names of the standard headers, and of the skeleton's own variables."""

LANGUAGE = HostLanguage(
    name="c",
    title="C",
    extension="h",
    skeleton=Path(__file__).with_name("binding.h.j2"),
    printer=CPrinter,
    texts=texts,
    style=Style(comments=("///", "//")),
    manner=Manner(
        reserved=frozenset((*_KEYWORDS.split(), *_OF_CPP.split(), *_OF_HEADERS.split(), *LIBRARY)),
        type_case=pascal,
        function_case=snake,
        value_case=snake,
        constant_case=snake,
        only_ascii=True,
        prefixed=True,
    ),
    has_namespace=True,
)
