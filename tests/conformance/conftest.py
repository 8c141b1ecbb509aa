"""The worker processes that all tests of this folder share, and what is done after each test."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator

import pytest

from .kit import Studio


@pytest.fixture(scope="session")
def studio() -> Iterator[Studio]:
    """Draws with every route and with the reference."""
    with Studio() as studio:
        yield studio


@pytest.fixture(autouse=True)
def memory_given_back() -> Iterator[None]:
    """After each test, returns to the system what the C library keeps of pictures long dropped.

    The reference needs some 500 MB for a picture, in thousands of pieces. Between these lie small
    ones that stay, so that without this a process would have grown to more than 1 GB.
    """
    yield
    library = ctypes.CDLL(None)
    if hasattr(library, "malloc_trim"):  # only glibc's
        library.malloc_trim(0)
