"""``frozen`` and ``record``: like dataclasses with slots, but cheap to declare.

Almost every record of the compiler is declared with it. ``dataclasses`` writes and compiles eight
methods for each class while the module is imported. This takes most of a millisecond for each
class; for a hundred classes, it would be the larger part of the time to start Burnish. Here only
the initialiser is made for each class, when its first record is made, and of code that is the same
for all classes with as many fields: ``initialisers.py`` has it. All other methods are shared.
Records are also made and unpickled faster, because nothing goes through ``__setattr__``.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from operator import attrgetter
from types import FunctionType, MappingProxyType
from typing import Any, Generic, Self, TypeVar, cast, dataclass_transform, overload
from weakref import WeakValueDictionary

from .initialisers import storing

T = TypeVar("T")

DEFAULTS = "__field_defaults__"
"""The attribute of a class of records that has the defaults of its fields by name."""

EMPTY: Any = MappingProxyType({})
"""The default of a field whose type is ``Mapping``."""


class cached_property(Generic[T]):  # noqa: N801 (It is used like the one of ``functools``.)
    """A property that is computed when it is first read, and kept in the record.

    Threads that are the first together all get one value. That of ``functools`` holds a lock while
    it computes, up to Python 3.11: one for all records of a class. Threads wait there for each
    other, and a process that is forked meanwhile waits for ever.
    """

    def __init__(self, compute: Callable[[Any], T]) -> None:
        self._compute = compute
        self._name = compute.__name__
        self.__doc__ = compute.__doc__

    @overload
    def __get__(self, instance: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: type[Any]) -> T: ...
    def __get__(self, instance: object | None, owner: type[Any]) -> T | Self:
        """The value; Python itself finds a kept one in the record, without calling this."""
        if instance is None:
            return self
        found: T = instance.__dict__.setdefault(self._name, self._compute(instance))
        return found


class _Fresh:
    """A placeholder for the default of a field that each record gets anew."""

    def __init__(self, factory: Callable[[], object]) -> None:
        self.factory = factory


def fresh(*, factory: Callable[[], T]) -> T:
    """The default of a field for which every record calls ``factory``: ``fresh(factory=list)``."""
    return cast(T, _Fresh(factory))


@overload
def frozen(cls: type[T], /) -> type[T]: ...
@overload
def frozen(
    *, eq: bool = True, kw_only: bool = False, key: bool = False, interned: bool = False
) -> Callable[[type[T]], type[T]]: ...
@dataclass_transform(frozen_default=True, field_specifiers=(fresh,))
def frozen(
    cls: type[T] | None = None,
    /,
    *,
    eq: bool = True,
    kw_only: bool = False,
    key: bool = False,
    interned: bool = False,
) -> Any:
    """Make a class of slotted, immutable records.

    Its annotations are the fields, in the order of the initialiser's parameters. They must be texts
    (``from __future__ import annotations``). With ``eq=False`` a record is equal only to itself;
    with ``kw_only=True`` fields are initialised by name. The fields of a base, which has to be such
    a class, come first. ``key=True`` is for records that are part of keys much more often than they
    are made: the hash is computed when the record is made. Such a record has no ``fresh`` fields.
    ``interned=True`` is for those that are compared just as often: equal fields give the same
    record, so that hashing and comparing are those of objects.
    """
    shared = _ANY | _UNCHANGEABLE | (_KEPT_HASH if key else {})
    if cls is None:
        if interned:
            return lambda decorated: _slotted(decorated, shared, False, kw_only, interned=True)
        return lambda decorated: _slotted(decorated, shared, eq, kw_only)
    return _slotted(cls, shared, eq, kw_only)


@dataclass_transform(eq_default=False, field_specifiers=(fresh,))
def record(cls: type[T], /) -> type[T]:
    """Make a class of slotted records that can be changed; each is equal only to itself."""
    return _slotted(cls, _ANY, eq=False, kw_only=False)


def changed(record: T, **changes: Any) -> T:
    """A copy of a record in which some fields are changed."""
    kind: Any = type(record)
    for name in kind.__match_args__:
        if name not in changes:
            changes[name] = getattr(record, name)
    made: T = kind(**changes)
    return made


def _slotted(
    cls: type[T], shared: dict[str, Any], eq: bool, kw_only: bool, *, interned: bool = False
) -> type[T]:
    texts: dict[str, str] = cls.__annotations__
    own_names = [name for name, text in texts.items() if not text.startswith("ClassVar")]
    inherited: tuple[str, ...] = getattr(cls, "__match_args__", ())
    names = tuple(dict.fromkeys((*inherited, *own_names)))
    members = {k: v for k, v in cls.__dict__.items() if k not in ("__dict__", "__weakref__")}
    defaults = dict(getattr(cls, DEFAULTS, {}))
    defaults |= {name: members.pop(name) for name in own_names if name in members}
    slots = [name for name in own_names if name not in inherited]
    if "__hash__" in shared and not hasattr(cls, "_hash"):
        slots.append("_hash")
    if interned:
        slots.append("__weakref__")
    if any(isinstance(member, cached_property) for member in members.values()):
        slots.append("__dict__")  # Where cached values are kept.
    own = {"__slots__": tuple(slots), "__match_args__": names, DEFAULTS: defaults}
    compared = _by_value(names) if eq else {}
    made: Any = type(cls.__name__, cls.__bases__, compared | shared | members | own)
    made.__qualname__ = cls.__qualname__
    if interned:
        made.__new__ = _interning(made, defaults, kw_only)
    else:
        made.__init__ = _on_first_use(made, defaults, kw_only)
    if kw_only:
        made.__reduce__ = _reduced_by_name
    kind: type[T] = made
    return kind


def _interning(cls: Any, defaults: dict[str, object], kw_only: bool) -> Callable[..., object]:
    """A ``__new__`` that gives the record with the same fields, if there is one.

    A record is forgotten when nothing refers to it any more.
    """
    known: WeakValueDictionary[tuple[object, ...], object] = WeakValueDictionary()
    initialiser = cache(lambda: _initialiser(cls, defaults, kw_only))

    def new(_cls: type, *fields: object, **named: object) -> object:
        found = None if named else known.get(fields)
        if found is None:
            made: object = object.__new__(cls)
            initialiser()(made, *fields, **named)
            found = known.setdefault(_values(made), made)
        return found

    return new


def _on_first_use(cls: Any, defaults: dict[str, object], kw_only: bool) -> Callable[..., None]:
    """An initialiser that makes the real one when it is first called."""

    def first(self: object, *arguments: object, **named: object) -> None:
        cls.__init__ = _initialiser(cls, defaults, kw_only)
        cls.__init__(self, *arguments, **named)

    return first


def _initialiser(cls: Any, defaults: dict[str, object], kw_only: bool) -> Callable[..., None]:
    """Make an initialiser that stores each argument in its slot, without ``__setattr__``."""
    names: tuple[str, ...] = cls.__match_args__
    keeps_hash = hasattr(cls, "_hash")
    used: dict[str, object] = {"keep_hash": cls._hash.__set__} if keeps_hash else {}
    for number, name in enumerate(names):
        used[f"set_{number}"] = _setter(getattr(cls, name).__set__, defaults.get(name))
    code = storing(len(names), keeps_hash).replace(co_varnames=("self", *names))
    if kw_only:
        code = code.replace(co_argcount=1, co_kwonlyargcount=len(names))
    initialiser = FunctionType(code, used)
    if kw_only:
        initialiser.__kwdefaults__ = defaults
    else:
        initialiser.__defaults__ = tuple(defaults[name] for name in names if name in defaults)
    return initialiser


def _setter(store: Callable[[Any, object], None], default: object) -> Callable[[Any, object], None]:
    """A function that stores an argument in its slot, and a new value for a fresh default."""
    if not isinstance(default, _Fresh):
        return store

    def store_anew(record: object, value: object) -> None:
        store(record, default.factory() if value is default else value)

    return store_anew


def _by_value(names: tuple[str, ...]) -> dict[str, Any]:
    values: Callable[[Any], object] = attrgetter(*names) if names else type

    def equal(self: object, other: object) -> object:
        if self is other:
            return True
        if other.__class__ is not self.__class__:
            return NotImplemented
        return values(self) == values(other)

    return {"__eq__": equal, "__hash__": lambda self: hash(values(self))}


def _kept_hash(self: Any) -> int:
    found: int = self._hash
    return found


_KEPT_HASH: dict[str, Any] = {"__hash__": _kept_hash}


def _shown(self: Any) -> str:
    fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__match_args__)
    return f"{type(self).__qualname__}({fields})"


def _reduced(self: Any) -> tuple[Any, ...]:
    return type(self), _values(self)


def _reduced_by_name(self: Any) -> tuple[Any, ...]:
    kind: Any = type(self)
    fields = dict(zip(kind.__match_args__, _values(self), strict=True))
    return partial(kind, **fields), ()


def _values(self: Any) -> tuple[Any, ...]:
    return tuple([getattr(self, name) for name in self.__match_args__])


def _refused(self: object, name: str, *_: object) -> None:
    raise AttributeError(f"{type(self).__qualname__}.{name} cannot change")


_ANY: dict[str, Any] = {
    "__repr__": _shown,
    "__reduce__": _reduced,
}
_UNCHANGEABLE: dict[str, Any] = {
    "__setattr__": _refused,
    "__delattr__": _refused,
}
