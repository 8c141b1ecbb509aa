"""Loads and fills in skeletons, the Jinja2 templates of whole files.

The emitter asks ``renderer`` for a function that turns a ``FileView`` into a text. Text of the user
is data to a skeleton, never code. A language's skeleton extends ``skeleton.j2`` and overrides
blocks of it.

Jinja resolves inheritance each time that a template is rendered: it copies all variables for each
block, and a block does not see the variables of the loop around it. So inheritance is resolved
here, once, before a skeleton is compiled: every block is replaced by the language's own block.

The result is translated to Python (``skeleton_compiler.py``). This is done when the package is
built: ``generate.py`` asks for ``functions_to_generate``. So Jinja is imported only for a skeleton
that has changed since.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...compiler.precomputed import Precomputations, key, precomputed

if TYPE_CHECKING:
    from jinja2 import Environment
    from jinja2.nodes import Block, Node
    from jinja2.nodes import Template as Tree

    from ..description.forms import Forms
    from ..description.profile import Profile
    from .views import FileView, FunctionFileView

_HERE = Path(__file__).parent
FUNCTIONS = _HERE / "functions.j2"
"""The skeleton of functions that an engine calls, which all languages share."""
_EXTENDS = re.compile(r'\{% extends "([\w.]+)" %\}\n')
_BRANCHES = ("body", "elif_", "else_")
"""The fields of Jinja's statements that hold other statements."""

Renderer = Callable[["FileView | FunctionFileView", "Forms", "Profile", bool], str]
"""Fills a skeleton in. Its parameters are called ``file``, ``forms``, ``profile`` and
``flip_y``."""


@cache
def renderer(path: Path) -> Renderer:
    """The function that fills in the skeleton at ``path``."""
    sources = tuple(skeleton_texts(path))
    found: Renderer | None = precomputed("skeletons", _key(sources))
    if found is not None:
        return found
    code = _translated(sources, "render")
    if code is None:
        return by_jinja(path)
    names: dict[str, Any] = {"joiner_": joiner}
    exec(compile(code, path.name, "exec"), names)
    made: Renderer = names["render"]
    return made


def functions_to_generate(paths: Iterable[Path]) -> Precomputations:
    """The functions for which ``renderer`` looks, as code.

    Each is called ``render_`` and its key. A skeleton that is left to Jinja has none.
    """
    found = {_key(sources): sources for sources in (tuple(skeleton_texts(path)) for path in paths)}
    return {key: partial(_translated, found[key], f"render_{key}") for key in found}


def _key(sources: tuple[str, ...]) -> str:
    return key(*sources, (_HERE / "skeleton_compiler.py").read_text(encoding="utf-8"))


def _translated(sources: tuple[str, ...], function: str) -> str | None:
    """The code of a function that fills the skeleton in; none if it has to be left to Jinja."""
    from .skeleton_compiler import UnsupportedError, translated

    try:
        return translated(_flat(_environment(), sources), function)
    except UnsupportedError:
        return None


def by_jinja(path: Path) -> Renderer:
    """The skeleton as Jinja itself fills it in."""
    from jinja2 import Template

    environment = _environment()
    code = environment.compile(_flat(environment, tuple(skeleton_texts(path))), path.name)
    template = Template.from_code(environment, code, environment.make_globals(None))
    return lambda file, forms, profile, flip_y: template.render(
        file=file, forms=forms, profile=profile, flip_y=flip_y
    )


def joiner(separator: str) -> Callable[[], str]:
    """Jinja's function: its result returns ``separator``, but nothing the first time."""
    given = iter(("",))
    return lambda: next(given, separator)


def skeleton_texts(path: Path) -> Iterator[str]:
    """The text of a skeleton, then that of the one it extends: a file beside it, or one in here."""
    source = path.read_text(encoding="utf-8")
    extends = _EXTENDS.match(source)
    yield source[extends.end() :] if extends else source
    if extends:
        beside = path.parent / extends[1]
        yield from skeleton_texts(beside if beside.is_file() else _HERE / extends[1])


def _flat(environment: Environment, sources: tuple[str, ...]) -> Tree:
    """One template: the last source, in which blocks of the sources before it replace its own."""
    from jinja2.nodes import Block

    *derived, base = map(environment.parse, sources)
    overriding: dict[str, Block] = {}
    for template in derived:
        for block in template.find_all(Block):
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
    from jinja2 import Environment, StrictUndefined

    return Environment(
        autoescape=False,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
