"""Computations of a host: the operations that the reflection describes as steps.

Semantics asks where only a host can compute something, such as the number of elements that a kernel
writes, and where it may, such as the levels that divide all patches. ``reflection/values.py``
describes the steps.
"""

from __future__ import annotations

from collections.abc import Mapping

PLAIN = frozenset(("vector", "splat", "matrix", "array", "index", "select", "apply"))
"""Operations that their arguments describe completely."""

KEYS: Mapping[str, str] = {
    "parameter": "parameter",
    "constant": "value",
    "call": "function",
    "native": "function",
    "swizzle": "lanes",
    "member": "member",
    "bound": "binder",
    "texture": "texture",
}
"""The name of the field of a step that holds the data of an operation."""

KNOWN_TO_HOST = PLAIN | KEYS.keys() | {"fold"}
"""The operations that a host computes, in a graph whose binders are closed."""

KNOWN_IN_TREES = KNOWN_TO_HOST | {"as", "called"}
"""The operations that a host computes in checked trees, which also have annotations."""
