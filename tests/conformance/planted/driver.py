"""A driver's process with an error in it: ``python -m burnish.tests.conformance.planted.driver
MODULE WRONG BEFORE AFTER [ARGUMENT …]``.

``MODULE`` is the driver's own. While it loads, the text ``BEFORE`` of the module ``WRONG`` becomes
``AFTER``. ``test_planted_plans.py`` has a runner start it in place of the driver.
"""

from __future__ import annotations

import runpy
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import ModuleType


class Wrong(MetaPathFinder):
    """Finds one module, with another text."""

    def __init__(self, name: str, before: str, after: str) -> None:
        self._name, self._before, self._after = name, before, after

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The module's place, if it is this one."""
        found = PathFinder.find_spec(name, path, target) if name == self._name else None
        if found is not None and found.origin is not None:
            found.loader = _Changed(name, found.origin, self._before, self._after)
        return found


class _Changed(SourceFileLoader):
    def __init__(self, name: str, path: str, before: str, after: str) -> None:
        super().__init__(name, path)
        self._before, self._after = before.encode(), after.encode()

    def get_data(self, path: str) -> bytes:
        """The changed text of the module; it has no other file."""
        if path != self.path:
            raise FileNotFoundError(path)
        source = super().get_data(path)
        assert source.count(self._before) == 1, f"{path} does not say {self._before!r} once"
        return source.replace(self._before, self._after)

    def set_data(self, path: str, data: object, *, _mode: int = 0) -> None:
        """Nothing of it is kept."""


def main(module: str, wrong: str, before: str, after: str, *arguments: str) -> None:
    """Be the driver."""
    sys.meta_path.insert(0, Wrong(wrong, before, after))
    sys.argv = [module, *arguments]
    runpy.run_module(module, run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
