"""Fills the templates of this folder."""

from __future__ import annotations

from pathlib import Path

_HERE = Path(__file__).parent


def filled(template: str, **values: object) -> str:
    """The text of a template; it is an error if it reads anything else than ``values``."""
    from jinja2 import Environment, StrictUndefined

    environment = Environment(
        autoescape=False, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
    text = (_HERE / template).read_text(encoding="utf-8")
    return environment.from_string(text).render(values)
