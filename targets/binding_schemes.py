"""Reads the binding schemes that users ask for: files of TOML, or mappings with the same content.

``api/compiling.py`` asks, and gives every chosen profile the scheme. What a scheme may say is
declared in the rows below; a mistake is an error that names the file and what is wrong in it, and
all mistakes of a scheme are told at once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import Report
from ..compiler.diagnostics.nearest import suggestion
from ..compiler.inputs import Inputs
from ..compiler.ir.leaves import LARGEST_PLACE
from ..compiler.syntax.load import load_source
from ..support.frozen import changed, frozen
from .description.binding_scheme import BindingScheme
from .description.profile import Profile, Samplers

IN_MEMORY = "<bindings>"
"""The name of a scheme that is a mapping, in messages."""

_KINDS = ("block", "buffer", "texture", "sampler")
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def scheme_in(path: Path, inputs: Inputs, report: Report) -> BindingScheme | None:
    """The scheme in a file; ``None`` after reporting what is wrong."""
    import tomllib

    known = inputs.content(path)
    if known is None:
        source = load_source(path, report, seen=lambda content: inputs.read(path, content))
        text = None if source is None else source.text
    else:
        text = known.decode("utf-8-sig")
    if text is None:
        return None
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        reason = str(error)
        problem = f"this is no TOML: {reason[:1].lower()}{reason[1:]}"
        report.add(rules.BINDING_SCHEME, None, file=path, problem=problem)
        return None
    return scheme_of(document, str(path), report)


def scheme_of(document: Mapping[str, Any], name: str, report: Report) -> BindingScheme | None:
    """The scheme that a document describes; ``None`` after reporting what is wrong."""
    fields: dict[str, Any] = {}
    failed = False
    for key, value in document.items():
        row = _ROWS.get(key)
        if row is None:
            problems = [f"there is no `{key}`: {suggestion(key, _ROWS) or _LISTED}"]
        else:
            problems = list(row.problems(key, value))
            fields[key] = value
        for problem in problems:
            report.add(rules.BINDING_SCHEME, None, file=name, problem=problem)
            failed = True
    if failed:
        return None
    sets = {**BindingScheme().sets, **fields.pop("sets", {})}
    return BindingScheme(sets=sets, **fields)


def with_scheme(profile: Profile, scheme: BindingScheme) -> Profile:
    """A profile whose texts are bound by a scheme."""
    made = changed(profile, scheme=scheme)
    if scheme.combined_samplers and profile.can_combine_samplers:
        # Reads need no extension where no texture is apart from its sampler.
        return changed(made, samplers=Samplers(combined=True), requires={})
    return made


@frozen
class _Row:
    """A key of a scheme."""

    problems: Callable[[str, object], Iterator[str]]
    """Gives what is wrong with its value, as sentences."""


def _numbers(names: Callable[[str], str], example: str) -> Callable[[str, object], Iterator[str]]:
    """The check of a table of numbers; ``names`` says what is wrong with a name, or nothing."""

    def problems(key: str, value: object) -> Iterator[str]:
        if not isinstance(value, Mapping):
            yield f"`{key}` is a table of numbers, as in `{key} = {{ {example} = 1 }}`"
            return
        for name, number in value.items():
            if wrong := names(str(name)):
                yield f"`{key}` has no number for `{name}`: {wrong}"
            elif type(number) is not int or not 0 <= number <= LARGEST_PLACE:
                yield f"`{key}.{name}` is a whole number from 0 to {LARGEST_PLACE}"

    return problems


def _group(name: str) -> str:
    return "" if _NAME.fullmatch(name) else "this is no name of a group"


def _kind(name: str) -> str:
    return "" if name in _KINDS else f"the kinds are {', '.join(_KINDS)}"


def _flag(key: str, value: object) -> Iterator[str]:
    if not isinstance(value, bool):
        yield f"`{key}` is true or false"


def _name_of_group(key: str, value: object) -> Iterator[str]:
    if not isinstance(value, str) or _group(value):
        yield f'`{key}` is the name of a group, as in `{key} = "draw"`'


_ROWS: Mapping[str, _Row] = {
    "sets": _Row(_numbers(_group, "draw")),
    "resources": _Row(_numbers(_group, "draw")),
    "first": _Row(_numbers(_group, "draw")),
    "kinds": _Row(_numbers(_kind, "block")),
    "combined_samplers": _Row(_flag),
    "push_constants": _Row(_name_of_group),
}
"""The keys of a scheme, which are the fields of ``BindingScheme``."""

_LISTED = f"there are {', '.join(_ROWS)}"
