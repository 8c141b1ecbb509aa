"""``burnish.testing``: what tests of other programs call, and the plugin of pytest."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from burnish.testing import GoldenError, assert_in_bounds

from ..suite.processes import run
from .kit import CASE, bounds, flat, small_golden, write_case, write_golden


def test_a_good_picture_says_nothing(tmp_path: Path) -> None:
    golden = small_golden(tmp_path)
    assert_in_bounds(flat(0.3), golden)
    assert_in_bounds(flat(0.3).tolist(), str(golden), case="defaults", output="color")
    np.save(tmp_path / "p.npy", flat(0.3))
    assert_in_bounds(tmp_path / "p.npy", golden)
    assert_in_bounds(flat(136).astype("u1")[..., :3], golden, encoding="srgb")


def test_the_message_of_a_bad_picture(tmp_path: Path) -> None:
    golden = small_golden(tmp_path)
    picture = flat(0.3)
    picture[1, 2, 1] = 0.625
    with pytest.raises(AssertionError) as caught:
        assert_in_bounds(picture, golden, case=CASE, diff=tmp_path / "d" / "out.png")
    assert str(caught.value) == (
        f"{CASE}/color of {golden}: outside of its bounds: 1 of 6 pixels compared, 0 undecided\n"
        "  the worst is pixel 2,1, lane 1 (g): 0.625 is not within 0.25 and 0.5\n"
        f"  {tmp_path / 'd' / 'out.png'} shows where"
    )
    assert (tmp_path / "d" / "out.png").stat().st_size > 50


def test_rows_from_below(tmp_path: Path) -> None:
    golden = small_golden(tmp_path)
    picture = flat(0.3)
    picture[0, 0, 0] = 1
    with pytest.raises(AssertionError, match=r"pixel 0,1"):
        assert_in_bounds(picture, golden, flip=True)


def test_what_cannot_be_compared_is_another_error(tmp_path: Path) -> None:
    golden = small_golden(tmp_path)
    with pytest.raises(GoldenError, match="2 x 2 pixels large"):
        assert_in_bounds(np.zeros((2, 2, 4)), golden)
    with pytest.raises(GoldenError, match="no encoding `gamma`"):
        assert_in_bounds(flat(0.3), golden, encoding="gamma")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="no golden folder"):
        assert_in_bounds(flat(0.3), tmp_path / "other")


SUITE = """
import numpy as np
from burnish.testing import assert_in_bounds

def test_mine():
    picture = np.full((2, 3, 4), 0.3)
    picture[1, 2, 1] = 0.625
    assert_in_bounds(picture, "g")
"""


def suite(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a test suite of somebody else."""
    small_golden(folder / "g")
    (folder / "test_mine.py").write_text(SUITE)
    (folder / "pytest.ini").write_text("[pytest]\n")
    return outcome_of(folder, *words)


def outcome_of(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run the tests of a folder, without what these tests themselves are run with."""
    environment = {
        **os.environ, "PYTEST_ADDOPTS": "", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }  # fmt: skip
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *words]
    return run(command, cwd=folder, env=environment)


def test_under_pytest_the_failure_points_to_the_users_line(tmp_path: Path) -> None:
    result = suite(tmp_path)
    assert result.returncode == 1
    assert '>       assert_in_bounds(picture, "g")' in result.stdout
    assert "pixel 2,1, lane 1 (g): 0.625 is not within 0.25 and 0.5" in result.stdout
    assert "within.py" not in result.stdout


def test_the_plugin_keeps_pictures_of_failures(tmp_path: Path) -> None:
    result = suite(tmp_path, "-p", "burnish.testing", "--golden-diffs", "diffs")
    assert result.returncode == 1
    kept = tmp_path / "diffs" / "Plain-defaults-color.png"
    assert kept.is_file()
    assert f"{kept} shows where" in re.sub(r"\n *E? *", " ", result.stdout)


def test_the_example_of_the_page(tmp_path: Path) -> None:
    """The page's test is run with an engine that draws what is right, and another one."""
    page = Path(__file__).parents[2] / "docs" / "golden.md"
    (example,) = re.findall(r"^```py\n(.*?)^```$", page.read_text("utf-8"), re.M | re.S)
    engine = "import numpy\ndef draw_plastic(case):\n    return numpy.full((2, 3, 4), {})\n"
    write_golden(
        tmp_path / "golden",
        write_case(tmp_path / "golden", *bounds(), folder="Plastic/inside"),
        write_case(tmp_path / "golden", *bounds(), folder="Plastic/behind"),
    )
    (tmp_path / "test_page.py").write_text(example)
    (tmp_path / "pytest.ini").write_text("[pytest]\npythonpath = .\n")
    for value, code in ((0.3, 0), (0.6, 1)):
        (tmp_path / "my_engine.py").write_text(engine.format(value))
        assert outcome_of(tmp_path).returncode == code


def test_importing_loads_neither_the_compiler_nor_pillow(tmp_path: Path) -> None:
    text = (
        "import sys, burnish.testing\n"
        "loaded = [name for name in sys.modules if name in ('PIL', 'lark', 'click', 'pytest')"
        " or name.startswith(('burnish.api', 'burnish.compiler.semantics', 'burnish.commands'))]\n"
        "assert not loaded, loaded\n"
    )
    result = run([sys.executable, "-c", text], cwd=tmp_path)
    assert result.returncode == 0, result.stderr
