"""The skeletons around the printed pieces. User's text is only ever data to them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from ...compiler.cache import cached

if TYPE_CHECKING:
    from jinja2 import Environment, Template


def render(path: Path, context: Mapping[str, object]) -> str:
    """The skeleton at ``path``, filled in."""
    return _template(path).render(context)


@cache
def _template(path: Path) -> Template:
    """The skeleton, compiled to Python once for each content and version of Jinja."""
    from jinja2 import Template as Compiled
    from jinja2 import __version__ as version

    environment = _environment()
    source = path.read_text(encoding="utf-8")
    code = cached(
        "template", (source, path.name, version), lambda: environment.compile(source, path.name)
    )
    return Compiled.from_code(environment, code, environment.make_globals(None))


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
