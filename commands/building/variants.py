"""The variants of a build: ways to compile all of its files, each with options of its own.

``burnish build`` has some of the options of ``burnish compile``, and those of ``--variant`` are
added to them. The rigs of a file are no variants: ``planning.py`` finds these by itself.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource
from click.decorators import FC

from ...support.frozen import changed
from ..compile_options import (
    BINDINGS,
    EMIT,
    ENGINE,
    FLIP_Y,
    FORCE,
    HOIST,
    LINE_DIRECTIVES,
    NATIVE_STAGES,
    OPTIMIZE,
    PASS,
    PREFIX,
    RIG,
    SET,
    SINGLE_FILE,
    SLOTS,
    TARGET,
    TOGETHER,
    VALIDATE,
    CompileRequest,
)
from ..options import each_once, option
from .actions import Variant, options_of

OF_VARIANTS = (
    TARGET, EMIT, OPTIMIZE, ENGINE, SLOTS, TOGETHER, PREFIX, RIG, PASS, SET, VALIDATE, SINGLE_FILE,
    FLIP_Y, LINE_DIRECTIVES, HOIST, BINDINGS, NATIVE_STAGES, FORCE,
)  # fmt: skip
"""The options of ``burnish compile`` that a build has, and each of its variants."""
_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")
_HINT = "--variant"


def variants_of(
    output: str, search_path: Sequence[Path], options: Mapping[str, Any], given: Iterable[str]
) -> list[Variant]:
    """The variants of a command line, or the only one. Raises ``UsageError``."""
    usual = CompileRequest(files=(), output=output, search_path=tuple(search_path), **options)
    found = [Variant(name, _changed(usual, name, words)) for name, words in _named(given)]
    return found or [Variant("", usual)]


def asked_for(options: Mapping[str, Any]) -> list[str]:
    """The words of a command line that has these options."""
    return options_of(CompileRequest(files=(), output="", **options), OF_VARIANTS)


def with_options(command: FC) -> FC:
    """A command with the options of variants."""
    for row in reversed(OF_VARIANTS):
        command = option(row)(command)
    return command


def _named(given: Iterable[str]) -> Iterator[tuple[str, str]]:
    """The names of variants, with their options. Raises ``BadParameter``."""
    known: set[str] = set()
    for text in given:
        name, colon, words = text.partition(":")
        name = name.strip()
        if not colon or not _NAME.fullmatch(name):
            raise click.BadParameter(
                f"'{text}' is not NAME:OPTIONS, such as 'night: --rig Night'", param_hint=_HINT
            )
        if name.casefold() in known:
            raise click.BadParameter(f"there are two called '{name}'", param_hint=_HINT)
        known.add(name.casefold())
        yield name, words


def _changed(usual: CompileRequest, name: str, words: str) -> CompileRequest:
    """The options of all variants with those of one. Raises ``BadParameter``."""
    command = with_options(click.Command(name, add_help_option=False))
    try:
        context = command.make_context(name, shlex.split(words))
    except click.UsageError as error:
        raise click.BadParameter(f"'{name}': {error.message}", param_hint=_HINT) from error
    except ValueError as error:
        raise click.BadParameter(f"'{name}': {error}", param_hint=_HINT) from error
    own = {
        field: value
        for field, value in context.params.items()
        if context.get_parameter_source(field) is ParameterSource.COMMANDLINE
    }
    if "values" in own:
        own["values"] = (*usual.values, *own["values"])
        each_once(own["values"])
    return changed(usual, **own)
