"""Roles of values for a program that shows scenes: the camera, the place of an object.

``parameters.py`` marks the rows of the reflection and of plans by it, and
``targets/runner/scene.py`` sets scenes up by the same file of the library.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from ..ir.node import Node
from ..ir.shader import ParameterInfo
from ..precomputed import Precomputations, key, precomputed
from .well_known import well_known

_NAMES = Path(__file__).parents[2] / "stdlib" / "scene.toml"


@cache
def scene_names() -> Mapping[str, Mapping[str, str]]:
    """The meanings of the library's declarations in a scene, by kind."""
    text = _NAMES.read_text(encoding="utf-8")
    found: Mapping[str, Mapping[str, str]] | None = precomputed("scene", key(text))
    return _read(text) if found is None else found


def scene_names_to_generate() -> Precomputations:
    """The meanings that ``scene_names`` looks for: to load ``tomllib`` takes milliseconds."""
    text = _NAMES.read_text(encoding="utf-8")
    return {key(text): lambda: _read(text)}


def _read(text: str) -> Mapping[str, Mapping[str, str]]:
    import tomllib

    return tomllib.loads(text)


def role_of_derived(value: Node, roles: Mapping[str, str | None]) -> str | None:
    """The scene's name for a value that the host computes, if it has one for it.

    It has names for functions of values that have a name themselves. ``roles`` are those of the
    parameters, by the parameters' names.
    """
    found = well_known(value)
    if found is None:
        return None
    function, parameter = found
    return scene_names()["derived"].get(f"{function}({roles.get(parameter.name)})")


def known_roles() -> tuple[str, ...]:
    """The scene's names for values of parameters, whatever material has them, in order."""
    names = scene_names()
    return tuple(dict.fromkeys([*names["parameters"].values(), *names["types"].values()]))


def role_of(info: ParameterInfo) -> str | None:
    """The scene's name for the value of a parameter, if it has one for it."""
    names = scene_names()
    return names["parameters"].get(info.library) or names["types"].get(info.declared_type)
