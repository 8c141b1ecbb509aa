"""Finds values that were computed when the package was built.

The parser's tables, the syntax trees of the standard library, the words of scenes, the skeletons as
Python functions and the host's table of builtins take longer to compute than a material takes to
compile. ``generate.py`` writes them as modules into the package ``generated``, when a wheel is
built or a checkout is installed. They are loaded like all other code of the installation, and from
nowhere else.

The functions that need such a value ask for it by ``precomputed``, with a key that is the digest of
everything that the value depends on. If somebody has changed one of these files since, or if
nothing was generated, nothing is found, and they compute the value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from .cache import digest

Precomputations = Mapping[str, Callable[[], object]]
"""Functions that compute values when the package is built, by the keys of the values."""


def key(*texts: str) -> str:
    """The key of a value that depends on these texts."""
    return digest("\0".join(texts).encode())


def precomputed(module: str, key: str) -> Any:
    """The value with a key in a module that ``generate.py`` wrote; ``None`` if it has none."""
    try:
        generated = import_module(f"..generated.{module}", __package__)
    except ModuleNotFoundError:
        return None
    return generated.VALUES.get(key)
