"""Documents in which one list, or one object with free keys, has as many elements as one likes.

The lists are found in the declarations of the records, so that those which a document gets later
are found as well. ``test_growing.py`` asks whether twice the elements are twice the work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal, get_args, get_origin

from burnish.compiler.constraints import Length, Nested, Pattern, Range
from burnish.compiler.documents.shapes import (
    Field,
    alternatives_of,
    bare,
    constraints_of,
    fields_of,
    is_record,
    may_be_null,
    telling,
    words_of,
)

Path = tuple[str | type, ...]
"""Keys in JSON, ``ANY``, and the kinds of records that are meant where there may be several."""
ANY = "*"
"""In a path, any element of a list, or any key of an object with free keys."""


@dataclass(frozen=True, slots=True)
class Growing:
    """A list or an object of a document that can have any number of elements."""

    path: Path
    element: Any
    """The type of its elements."""
    is_list: bool

    @property
    def name(self) -> str:
        """The name of a test's parameter."""
        return "/".join(each if isinstance(each, str) else each.__name__ for each in self.path)


def growing(kind: type) -> Sequence[Growing]:
    """All lists and objects of a kind of document that can be as long as one likes."""
    found: dict[Path, Growing] = {}
    for each in _inside(kind, (), ()):
        found.setdefault(each.path, each)
    return list(found.values())


def grown(document: Any, kind: type, where: Growing, count: int) -> Any:
    """A document with so many elements there: like those that it has, or the least that there may
    be. Each has names of its own."""
    return _changed(deepcopy(document), kind, where.path, partial(_filled, where, count))


def _filled(where: Growing, count: int, value: Any) -> Any:
    """A list or an object with so many elements, like the first one that it has."""
    values = list(value.values()) if isinstance(value, dict) else value
    sample = values[0] if isinstance(values, list) and values else _sample(where.element)
    is_word = get_origin(bare(where.element)) is Literal
    elements = [sample if is_word else _numbered(sample, number) for number in range(count)]
    if where.is_list:
        return elements
    return {f"key {number}": element for number, element in enumerate(elements)}


# --- types ---------------------------------------------------------------------------------------


def _inside(type_: Any, path: Path, around: tuple[type, ...]) -> Iterator[Growing]:
    """All that can grow in a value of a type. Some records contain themselves: once is enough."""
    inner = bare(type_)
    if any(isinstance(each, Nested) for each in constraints_of(type_)):
        yield Growing(path, type_, is_list=True)
    elif is_record(inner):
        if around.count(inner) > 1:
            return
        for field in fields_of(inner):
            yield from _inside(field.type, (*path, field.key), (*around, inner))
    elif (element := _element(inner)) is not None:
        if get_origin(inner) is not tuple or get_args(inner)[-1] is ...:
            yield Growing(path, element, is_list=get_origin(inner) is tuple)
        yield from _inside(element, (*path, ANY), around)
    elif get_origin(inner) is not Literal and len(kinds := alternatives_of(inner)) > 1:
        for kind in kinds:
            yield from _inside(kind, (*path, kind), around)
    elif (only := _only(inner)) is not inner:
        yield from _inside(only, path, around)


def _element(type_: Any) -> Any:
    """The type of the elements of a list or an object; ``None`` of anything else."""
    arguments = get_args(type_)
    if get_origin(type_) is tuple:
        return arguments[0] if arguments else None
    return arguments[1] if get_origin(type_) is get_origin(Mapping[str, int]) else None


def _only(type_: Any) -> Any:
    """A type that may be null, without null."""
    kinds = alternatives_of(type_)
    return kinds[0] if len(kinds) == 1 else type_


def _sample(type_: Any) -> Any:
    """The least value of a type."""
    constraints, inner = constraints_of(type_), bare(type_)
    if is_record(inner):
        return {each.key: _of_field(each) for each in fields_of(inner) if not each.is_optional}
    if may_be_null(inner):
        return None
    if get_origin(inner) is Literal:
        return get_args(inner)[0]
    if get_origin(inner) is tuple:
        arguments = get_args(inner)
        least = sum(each.least for each in constraints if isinstance(each, Length))
        count = least if arguments and arguments[-1] is ... else len(arguments)
        return [_sample(arguments[0]) for _ in range(count)]
    if _element(inner) is not None:
        return {}
    if len(kinds := alternatives_of(inner)) > 1:
        return _sample(kinds[-1])
    if inner is str:
        return "" if any(isinstance(each, Pattern) for each in constraints) else "x"
    if inner is bool:
        return False
    return next((each.least or 0 for each in constraints if isinstance(each, Range)), 0)


def _of_field(field: Field) -> Any:
    """The least value of a field, in the words of documents."""
    sample = _sample(field.type)
    return field.spelling.get(sample, sample) if field.spelling and sample is not None else sample


# --- values --------------------------------------------------------------------------------------


def _changed(value: Any, type_: Any, path: Path, change: Callable[[Any], Any]) -> Any:
    """A value with what is made of the list or object at a path in it; what a document does not
    have on the way there is made."""
    inner = _only(bare(type_))
    if not path:
        return change(value)
    first, *others = path
    rest = tuple(others)
    if isinstance(first, type):
        right = value if _is(value, first, alternatives_of(inner)) else _sample(first)
        return _changed(right, first, rest, change)
    if first == ANY:
        return _changed_element(value, inner, rest, change)
    if value is None:
        value = _sample(inner)
    (type_of_member,) = [each.type for each in fields_of(inner) if each.key == first]
    return {**value, first: _changed(value.get(first), type_of_member, rest, change)}


def _changed_element(value: Any, type_: Any, path: Path, change: Callable[[Any], Any]) -> Any:
    """A list or an object with a change in the element that has most of the path."""
    element = _element(type_)
    change_one = partial(_changed, type_=element, path=path, change=change)
    if not value:
        made = change_one(_sample(element))
        return [made] if get_origin(type_) is tuple else {"key": made}
    rows = dict(enumerate(value)) if isinstance(value, list) else dict(value)
    best = max(rows, key=lambda key: _fits(rows[key], element, path))
    rows[best] = change_one(rows[best])
    return list(rows.values()) if isinstance(value, list) else rows


def _fits(value: Any, type_: Any, path: Path) -> bool:
    """True if a value has the element that a path leads to next."""
    if not path or not isinstance(value, dict):
        return False
    first = path[0]
    if isinstance(first, type):
        return _is(value, first, alternatives_of(type_))
    return bool(value.get(first))


def _is(value: Any, kind: type, kinds: Sequence[type]) -> bool:
    """True if a value is a record of ``kind``, one of the ``kinds`` that are possible there."""
    if value is None or len(kinds) == 1:
        return value is not None
    key = telling(kinds)
    return value[key] in words_of(kind)[key]


def _numbered(sample: Any, number: int) -> Any:
    """An element with a name of its own, where it has one."""
    if number == 0:
        return sample
    if isinstance(sample, str):
        return f"{sample}{number}"
    if not isinstance(sample, dict):
        return deepcopy(sample)
    keys = ("name", "result", "reflection", "file")
    return {**sample, **{key: f"{sample[key]}{number}" for key in keys
                         if isinstance(sample.get(key), str)}}  # fmt: skip
