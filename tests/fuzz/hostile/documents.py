"""Changes documents at random: JSON of any kind, in which anything may become anything.

``test_documents.py`` does this to plans, to reflections and to the packages of web pages, and
``make fuzz`` for as long as one likes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import deepcopy
from random import Random
from typing import Any

Document = Any

MOST_CHANGES = 3
DEEPER = 0.93
"""The probability that a change concerns something inside a value, and not the whole value."""

NUMBERS: Sequence[Any] = (
    0, 1, -1, 2, 3, 4, 7, 31, 32, 255, 256, 65535, 65536, 2**24, 2**31 - 1, 2**31, -(2**31),
    2**32 - 1, 2**32, 2**53, -(2**53), 0.0, -0.0, 0.5, 1.0, -1.5, 1e-320, 1e38, 3.5e38, 1e300,
    -1e308,
)  # fmt: skip
TEXTS: Sequence[str] = (
    "", "x", "name", ".", "..", "/", "../x", "a/b", "\\", "C:x", "/etc/passwd", "/dev/zero", "\0",
    "\n", "\x1b[2J", "\u202e", "é", "𝕏", "x" * 5000, "float", "vec4", "ivec2", "mat4", "bool", "x9",
    "vec9", "Lamp[8]", "float[1000000000]", "[]", "rgba8", "depth32f_stencil8", "2d", "cube", "%s",
    "{0}", "true", "null", "1", "__class__",
)  # fmt: skip
SMALL: Sequence[Any] = (None, True, False, [], {}, [[]], [0], {"": 0}, [None], {"name": "x"})


def mutated(document: Document, random: Random) -> Document:
    """A document with one to three changes. What does not change is shared with the old one."""
    holder: list[Any] = [document]
    for _ in range(random.randint(1, MOST_CHANGES)):
        container, key = _copied(holder, _path(holder, random))
        random.choice(CHANGES)(random, container, key, holder[0])
        if not holder:
            return None
    return holder[0]


def _path(holder: list[Any], random: Random) -> list[Any]:
    """The keys from a document's holder to one of its values, which may be deep inside or not."""
    path: list[Any] = [0]
    value = holder[0]
    while isinstance(value, dict | list) and value and random.random() < DEEPER:
        keys: Sequence[Any] = list(value) if isinstance(value, dict) else range(len(value))
        path.append(random.choice(keys))
        value = value[path[-1]]
    return path


def _copied(holder: list[Any], path: Sequence[Any]) -> tuple[Any, Any]:
    """The container and the key of a value, where all containers around it have been copied."""
    inner: Any = holder
    for key in path[:-1]:
        inner[key] = inner[key].copy()
        inner = inner[key]
    return inner, path[-1]


def _anything(random: Random, whole: Document) -> Any:
    """A copy of some value of a document: in its place, that would contain itself."""
    value: Any = [whole]
    for key in _path(value, random):
        value = value[key]
    return deepcopy(value)


# --- changes -------------------------------------------------------------------------------------


def _delete(_random: Random, container: Any, key: Any, _whole: Document) -> None:
    del container[key]


def _replace(random: Random, container: Any, key: Any, _whole: Document) -> None:
    container[key] = random.choice(random.choice((NUMBERS, TEXTS, SMALL)))


def _near(random: Random, container: Any, key: Any, whole: Document) -> None:
    """Changes a number by one; replaces another value by any value of the document."""
    value = container[key]
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    container[key] = value + random.choice((-1, 1)) if is_number else _anything(random, whole)


def _move(random: Random, container: Any, key: Any, whole: Document) -> None:
    """Replaces a value by one from elsewhere under the same key, or by any other value."""
    for _ in range(20):
        other = _anything(random, whole)
        if isinstance(other, dict) and key in other:
            container[key] = other[key]
            return
    container[key] = _anything(random, whole)


def _repeat(random: Random, container: Any, key: Any, _whole: Document) -> None:
    """Repeats a value once or many times."""
    if isinstance(container, list):
        container[key:key] = [container[key]] * random.choice((1, 1, 2, 40))
    else:
        container[random.choice(TEXTS)] = container[key]


def _swap(random: Random, container: Any, key: Any, _whole: Document) -> None:
    keys = list(container) if isinstance(container, dict) else range(len(container))
    other = random.choice(list(keys))
    container[key], container[other] = container[other], container[key]


def _nest(random: Random, container: Any, key: Any, _whole: Document) -> None:
    for _ in range(random.choice((1, 2, 150))):
        container[key] = random.choice(([container[key]], {"members": container[key]}))


def _letters(random: Random, container: Any, key: Any, _whole: Document) -> None:
    """A text with a piece more or less."""
    value = container[key]
    if isinstance(value, str):
        at = random.randint(0, len(value))
        container[key] = value[:at] + random.choice(("", "x", ".", "[0]", "\n")) + value[at + 1 :]
    else:
        container[key] = str(value)[:100]


CHANGES: Sequence[Callable[[Random, Any, Any, Document], None]] = (
    _delete, _replace, _replace, _near, _near, _move, _move, _repeat, _swap, _nest, _letters,
)  # fmt: skip
