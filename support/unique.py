"""Names that stand side by side, each of which is given once."""

from __future__ import annotations

from collections.abc import Iterable


class Names:
    """The names of one scope, such as those of a function's variables."""

    def __init__(self, taken: Iterable[str]) -> None:
        """``taken`` are the names that nothing else may have."""
        self._taken = set(taken)

    def new(self, wish: str) -> str:
        """This name if it is free; else this name with a number."""
        name, number = wish, 1
        while name in self._taken:
            number += 1
            name = f"{wish}_{number}"
        self._taken.add(name)
        return name
