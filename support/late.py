"""Records with one field that is made when it is first read.

Most declarations of a file are never looked into: of a function that nobody calls, and of one that
is known to be right, only the header is read. ``syntax/stored.py`` makes such records.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, cast

from .locks import lock

L = TypeVar("L", bound="Late")

_MAKING = lock()


class Late:
    """A base for classes of records; ``late`` is the name of the field.

    Records that are made as usual have all their fields at once.
    """

    __slots__ = ("_make",)
    late: ClassVar[str]
    _make: Callable[[], object]
    """Makes the value of the field, as long as nobody has asked for it."""

    if not TYPE_CHECKING:  # Otherwise every name would count as one of a field.

        def __getattr__(self, name: str) -> object:
            """Python calls this where it finds nothing: the field is empty, or there is none."""
            if name != self.late:
                raise AttributeError(f"a {type(self).__qualname__} has no {name!r}")
            with _MAKING:  # Values are compared by identity, so all threads get the same.
                make = getattr(self, "_make", None)
                if make is not None:
                    object.__setattr__(self, name, make())
                    object.__delattr__(self, "_make")
            return object.__getattribute__(self, name)


def unfinished(kind: type[L], fields: Sequence[object], make: Callable[[], object]) -> L:
    """A record with all fields but the late one, which ``make`` will make."""
    made, hashable = object.__new__(kind), cast(Any, kind)
    for store, value in zip(_stores(hashable), fields, strict=True):
        store(made, value)
    object.__setattr__(made, "_make", make)
    return made


@cache
def _stores(kind: Any) -> list[Callable[[object, object], None]]:
    """Functions that set the fields of a record, without the late one."""
    return [getattr(kind, name).__set__ for name in other_fields(kind)]


@cache
def other_fields(kind: Any) -> tuple[str, ...]:
    """The names of the fields of a class of records, without the late one."""
    return tuple(name for name in kind.__match_args__ if name != kind.late)
