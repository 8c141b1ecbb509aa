"""Frozen records that cost next to nothing to declare.

``dataclasses`` writes some eight methods for every class and compiles them while the module is
imported: most of a millisecond a class, which a hundred classes make the larger part of starting
Burnish. Here only the initialiser is written out, and not before the first instance is made; all
other methods are shared.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any, TypeVar, dataclass_transform, overload

T = TypeVar("T")


@overload
def frozen(cls: type[T], /) -> type[T]: ...
@overload
def frozen(*, eq: bool) -> Callable[[type[T]], type[T]]: ...
@dataclass_transform(frozen_default=True)
def frozen(cls: type[T] | None = None, /, *, eq: bool = True) -> Any:
    """A class of slotted, unchangeable records, as ``dataclass(frozen=True, slots=True)`` makes it.

    The annotations are the fields, in the order of the initialiser's parameters; they have to be
    texts (``from __future__ import annotations``). With ``eq=False`` every record is equal to
    itself alone.
    """
    if cls is None:
        return lambda decorated: _frozen(decorated, eq)
    return _frozen(cls, eq)


def changed(record: T, **changes: Any) -> T:
    """A copy of a record with some fields changed."""
    values = {name: getattr(record, name) for name in type(record).__match_args__}  # type: ignore[attr-defined]
    return type(record)(**{**values, **changes})


def _frozen(cls: type[T], eq: bool) -> type[T]:
    annotations: dict[str, str] = cls.__dict__.get("__annotations__", {})
    names = tuple(name for name, text in annotations.items() if not text.startswith("ClassVar"))
    members = {k: v for k, v in cls.__dict__.items() if k not in ("__dict__", "__weakref__")}
    defaults = {name: members.pop(name) for name in names if name in members}
    shared = {"__repr__": _repr, "__reduce__": _reduce, "__setattr__": _refuse, "__delattr__": _refuse}
    if eq:
        shared |= _by_value(names)
    made = type(cls)(
        cls.__name__,
        cls.__bases__,
        {**shared, **members, "__slots__": names, "__match_args__": names},
    )
    made.__qualname__ = cls.__qualname__
    made.__init__ = _first_use(made, names, defaults)  # type: ignore[misc]
    return made


def _first_use(cls: Any, names: tuple[str, ...], defaults: dict[str, object]) -> Any:
    """An initialiser that writes the true one when it is first called."""

    def __init__(self: object, *arguments: Any, **named: Any) -> None:
        cls.__init__ = _initialiser(cls, names, defaults)
        cls.__init__(self, *arguments, **named)

    return __init__


def _initialiser(cls: Any, names: tuple[str, ...], defaults: dict[str, object]) -> Any:
    parameters = [f"{name}=_default_{name}" if name in defaults else name for name in names]
    setting = [f"    _set_{name}(self, {name})" for name in names] or ["    pass"]
    found: dict[str, Any] = {f"_default_{name}": value for name, value in defaults.items()}
    found |= {f"_set_{name}": getattr(cls, name).__set__ for name in names}
    exec("\n".join([f"def __init__({', '.join(['self', *parameters])}):", *setting]), found)
    return found["__init__"]


def _by_value(names: tuple[str, ...]) -> dict[str, Any]:
    values: Callable[[object], object] = attrgetter(*names) if names else _no_values

    def __eq__(self: object, other: object) -> bool:
        if other.__class__ is not self.__class__:
            return NotImplemented
        return values(self) == values(other)

    def __hash__(self: object) -> int:
        return hash(values(self))

    return {"__eq__": __eq__, "__hash__": __hash__}


def _no_values(_: object) -> object:
    return ()


def _repr(self: Any) -> str:
    shown = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__match_args__)
    return f"{type(self).__qualname__}({shown})"


def _reduce(self: Any) -> tuple[Any, ...]:
    return type(self), tuple([getattr(self, name) for name in self.__match_args__])


def _refuse(self: object, name: str, *_: object) -> None:
    raise AttributeError(f"{type(self).__qualname__}.{name} cannot change")
