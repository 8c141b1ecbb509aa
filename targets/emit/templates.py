"""Loads and fills in skeletons, the Jinja2 templates of whole files.

The emitter calls ``render`` for each text. Text of the user is data to a skeleton, never code.

A language's skeleton extends ``skeleton.j2`` and overrides blocks of it. Jinja resolves inheritance
each time that a template is rendered: it copies all variables for each block, and a block does not
see the variables of the loop around it. So inheritance is resolved here, once, before a skeleton is
compiled: every block is replaced by what the language says instead.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from ...compiler.cache import cached

if TYPE_CHECKING:
    from jinja2 import Environment, Template
    from jinja2.nodes import Block, Node
    from jinja2.nodes import Template as Tree

_EXTENDS = re.compile(r'\{% extends "([\w.]+)" %\}\n')
_BRANCHES = ("body", "elif_", "else_")
"""The fields of Jinja's statements that hold other statements."""


def render(path: Path, context: Mapping[str, object]) -> str:
    """The skeleton at ``path``, filled in with ``context``."""
    return _template(path).render(context)


@cache
def _template(path: Path) -> Template:
    """The compiled skeleton, which is kept between processes by its content."""
    from jinja2 import Template as Compiled
    from jinja2 import __version__ as version

    environment = _environment()
    sources = tuple(_sources(path))
    code = cached(
        "template",
        (*sources, path.name, version),
        lambda: environment.compile(_flat(environment, sources), path.name),
    )
    return Compiled.from_code(environment, code, environment.make_globals(None))


def _sources(path: Path) -> Iterator[str]:
    """The text of a skeleton, then that of the one it extends: a file beside it, or one in here."""
    source = path.read_text(encoding="utf-8")
    extends = _EXTENDS.match(source)
    yield source[extends.end() :] if extends else source
    if extends:
        beside = path.parent / extends[1]
        yield from _sources(beside if beside.is_file() else Path(__file__).parent / extends[1])


def _flat(environment: Environment, sources: tuple[str, ...]) -> Tree:
    """One template: the last source, in which blocks of the sources before it replace its own."""
    from jinja2.nodes import Block

    *heirs, base = map(environment.parse, sources)
    overriding: dict[str, Block] = {}
    for heir in heirs:
        for block in heir.find_all(Block):
            overriding.setdefault(block.name, block)
    base.body = list(_without_blocks(base.body, overriding))
    return base


def _without_blocks(nodes: list[Node], overriding: Mapping[str, Block]) -> Iterator[Node]:
    """``nodes`` with the content of each block in its place."""
    from jinja2.nodes import Block

    for node in nodes:
        if isinstance(node, Block):
            yield from _without_blocks(overriding.get(node.name, node).body, overriding)
            continue
        for branch in _BRANCHES:
            if hasattr(node, branch):
                setattr(node, branch, list(_without_blocks(getattr(node, branch), overriding)))
        yield node


@cache
def _environment() -> Environment:
    # Importing Jinja costs more than most compiles, and not every command renders a skeleton.
    from jinja2 import Environment, StrictUndefined

    return Environment(
        autoescape=False,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
