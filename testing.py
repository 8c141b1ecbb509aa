"""Asserts in tests of other programs that a picture lies within the bounds of a golden folder.

``burnish conform FILE --golden FOLDER`` writes such a folder, and docs/golden.md explains it. Tests
call ``assert_in_bounds``, under pytest or any other runner. It needs NumPy, and of Burnish only
what judges pictures.

The module is also a plugin of pytest for those who ask for it, by ``-p burnish.testing``: then
``--golden-diffs FOLDER`` keeps a picture of what is outside for each failure. It is no entry point
of pytest: everybody who has Burnish installed would load it with each run of tests, and most of
these compare no pictures.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .targets.conformance.golden.viewable import marked
from .targets.conformance.golden.within import (
    Encoding,
    GoldenError,
    Output,
    Verdict,
    bounds_of,
    judged,
    only,
    outputs_of,
    reference_of,
    sentence,
)

if TYPE_CHECKING:
    import pytest
    from numpy.typing import ArrayLike, NDArray

    Picture = ArrayLike | str | os.PathLike[str]

__all__ = ["GoldenError", "assert_in_bounds"]

_DIFFS: list[Path] = []
"""The folder that ``--golden-diffs`` names, if it does."""


def assert_in_bounds(
    picture: Picture,
    golden: str | os.PathLike[str],
    *,
    case: str | None = None,
    output: str | None = None,
    encoding: Encoding = "linear",
    flip: bool = False,
    diff: str | os.PathLike[str] | None = None,
) -> None:
    """Raise ``AssertionError`` if a picture has a number that no conforming device has.

    ``picture`` is an array of shape (height, width) or (height, width, lanes) with its top row
    first, or the path of an .npy, .png or .exr file. With ``flip`` the bottom row comes first.
    Arrays of floats are linear; those of ``uint8`` and ``uint16`` may be encoded as ``srgb``.

    ``golden`` is the folder, ``case`` one of its cases, such as ``Plastic/defaults``, and
    ``output`` one of its outputs. Both may be left out where there is only one. ``diff`` is a PNG
    file to write if the assertion fails: what is outside is red there.

    Raises ``GoldenError``, a ``ValueError``, for what cannot be compared: a damaged folder, or a
    picture of another size.
    """
    __tracebackhide__ = True
    wanted = only(outputs_of(Path(golden)), case, output)
    pixels = _pixels(picture, wanted)
    verdict = judged(pixels[::-1] if flip else pixels, wanted, encoding)
    if verdict.is_good:
        return
    lines = [f"{wanted.title} of {os.fspath(golden)}: {sentence(verdict)}"]
    lines += [f"  {path} shows where" for path in _shown(verdict, wanted, diff)]
    raise AssertionError("\n".join(lines))


def _pixels(picture: Picture, wanted: Output) -> NDArray[Any]:
    import numpy as np

    if isinstance(picture, str | os.PathLike):
        from .targets.conformance.golden.pictures import read_picture

        return read_picture(Path(picture), wanted)
    return np.asarray(picture)


def _shown(verdict: Verdict, wanted: Output, diff: str | os.PathLike[str] | None) -> list[Path]:
    """The files that show what is outside, after writing them."""
    named = wanted.title.replace("/", "-") + ".png"
    paths = [folder / named for folder in _DIFFS] + ([] if diff is None else [Path(diff)])
    if paths:
        content = marked(reference_of(wanted), verdict.outside, bounds_of(wanted)[2])
        for path in paths:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    return paths


# --- a plugin of pytest ---------------------------------------------------------------------------


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option of the plugin."""
    parser.getgroup("burnish").addoption(
        "--golden-diffs", metavar="FOLDER",
        help="keep a picture of what is outside of its bounds for each failure",
    )  # fmt: skip


def pytest_configure(config: pytest.Config) -> None:
    """Remember the folder for pictures."""
    folder = config.getoption("--golden-diffs")
    if folder is not None:
        _DIFFS[:] = [Path(folder).absolute()]


def pytest_unconfigure() -> None:
    """Forget the folder for pictures."""
    _DIFFS.clear()
