"""Runs a module of Burnish as a worker: ``python -EP launcher.py FOLDERS MODULE ARGUMENT…``.

``surroundings.python_worker`` makes this command. Python runs this file by its path, without
anything else of Burnish, so it does not matter what lies in the current folder. The package that
the file belongs to is then loaded from where the file is, and not searched for; ``FOLDERS`` are
searched for other packages that are found nowhere else.
"""

from __future__ import annotations

import os
import runpy
import sys
import time
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from threading import Thread

ROOT = Path(__file__).parents[2]
"""The folder of the package."""
PAUSE = 0.5
"""The seconds between two looks at whether the parent is alive."""


def main() -> None:
    """Run the module that the command line names."""
    Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    folders, module = sys.argv[1:3]
    sys.path += filter(None, folders.split(os.pathsep))
    _load(module.partition(".")[0])
    sys.argv[:] = [module, *sys.argv[3:]]
    runpy.run_module(module, run_name="__main__", alter_sys=True)


def _end_with(parent: int) -> None:
    """End this process once its parent has ended, which is when another process has adopted it.

    Linux does that by itself, see ``lifeline.py``. Windows tells nobody.
    """
    while os.getppid() == parent:
        time.sleep(PAUSE)
    os._exit(1)


def _load(package: str) -> None:
    spec = spec_from_file_location(
        package, ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
    )
    assert spec is not None and spec.loader is not None
    sys.modules[package] = module_from_spec(spec)
    spec.loader.exec_module(sys.modules[package])


if __name__ == "__main__":
    main()
