"""Keeps two builds from writing into one folder at once: ``running.py`` builds within ``held``."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..output import unwritable
from ..replacing import lock_folder
from .actions import BuildError

PATIENCE = 0.5
"""The seconds to wait for the folder: a single compile holds it for microseconds."""


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Hold a folder, which is made if need be. Raises ``BuildError`` if another build holds it.

    The system lets go of it when the process ends, however it does. Windows has no such locks, and
    neither have some file systems of a network: there, nobody is kept out.
    """
    is_new = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(folder, os.O_RDONLY) if os.name != "nt" else None
    except OSError as error:
        raise unwritable(folder, error.strerror or str(error)) from error
    try:
        give_up = time.monotonic() + PATIENCE
        while descriptor is not None and not lock_folder(descriptor):
            if time.monotonic() > give_up:
                raise BuildError(
                    f"another build is writing into `{folder}`: wait until it has ended, or name "
                    "another folder with -o"
                )
            time.sleep(0.01)
        yield
    finally:
        if is_new:
            with suppress(OSError):
                folder.rmdir()  # It is empty if nothing could be built.
        if descriptor is not None:
            os.close(descriptor)
