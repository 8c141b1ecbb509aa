"""The skeletons around the printed pieces. User's text is only ever data to them.

A language's skeleton extends ``skeleton.j2``. Jinja resolves inheritance whenever a template is
rendered, with a copy of all variables for each block, and hides variables of loops from blocks.
Here blocks are put into the place of those they override before a skeleton is compiled: that costs
nothing afterwards, and a block sees what stands around it.
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
"""Where statements of Jinja hold other statements."""


def render(path: Path, context: Mapping[str, object]) -> str:
    """The skeleton at ``path``, filled in."""
    return _template(path).render(context)


@cache
def _template(path: Path) -> Template:
    """The skeleton, compiled to Python once for each content and version of Jinja."""
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
    """The text of a skeleton, and of what it extends: beside it, or else what all share."""
    source = path.read_text(encoding="utf-8")
    extends = _EXTENDS.match(source)
    yield source[extends.end() :] if extends else source
    if extends:
        beside = path.parent / extends[1]
        yield from _sources(beside if beside.is_file() else Path(__file__).parent / extends[1])


def _flat(environment: Environment, sources: tuple[str, ...]) -> Tree:
    """The last source as one template; of a block that several have, the first has it its way."""
    from jinja2.nodes import Block

    *heirs, base = map(environment.parse, sources)
    overriding: dict[str, Block] = {}
    for heir in heirs:
        for block in heir.find_all(Block):
            overriding.setdefault(block.name, block)
    base.body = list(_without_blocks(base.body, overriding))
    return base


def _without_blocks(nodes: list[Node], overriding: Mapping[str, Block]) -> Iterator[Node]:
    """``nodes`` with what stands in blocks instead of the blocks."""
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
