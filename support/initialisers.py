"""The code of initialisers of records, which is the same for all classes with as many fields.

``frozen.py`` asks for it, and gives the code of each class the names of its own fields. To compile
code takes ten times as long as that, and would be a thirtieth of the time of a short command. So
the codes that are asked for most are compiled when the package is built: ``generate.py`` writes
them into a module of the package ``generated``, and this module compiles the others.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import import_module
from types import CodeType
from typing import Any

_LONGEST = 60
"""The largest number of fields for which code is generated: records of languages have most."""
_LONGEST_KEPT = 10
"""The same for records that keep their hashes."""


@cache
def storing(count: int, keeps_hash: bool) -> CodeType:
    """The code of an initialiser that stores ``count`` arguments, with names that mean nothing."""
    text = _text(count, keeps_hash)
    return _generated().get(text) or _compiled(text)


def texts_to_generate() -> list[str]:
    """The texts whose codes ``generate.py`` writes, by these texts, as ``VALUES``."""
    plain = [_text(count, keeps_hash=False) for count in range(_LONGEST + 1)]
    return [*plain, *(_text(count, keeps_hash=True) for count in range(1, _LONGEST_KEPT + 1))]


def _text(count: int, keeps_hash: bool) -> str:
    fields = [f"field_{number}" for number in range(count)]
    body = [f"set_{number}(self, {field})" for number, field in enumerate(fields)] or ["pass"]
    if keeps_hash:
        body.append(f"keep_hash(self, hash(({', '.join(fields)},)))")
    return f"def __init__({', '.join(['self', *fields])}):\n    " + "\n    ".join(body)


@cache
def _generated() -> Mapping[str, CodeType]:
    try:
        found: Mapping[str, CodeType] = import_module(
            "..generated.initialisers", __package__
        ).VALUES
    except ModuleNotFoundError:
        return {}
    return found


def _compiled(text: str) -> CodeType:
    known: dict[str, Any] = {}
    exec(text, known)
    code: CodeType = known["__init__"].__code__
    return code
