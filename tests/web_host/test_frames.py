"""The host in a browser: a package made by hand, and packages that it refuses."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from burnish.compiler.documents.reading import read
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.drivers.browser.driver import Browser
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import FrameTexels
from burnish.targets.web_host.serving.packages import Package

from .by_hand import FILLED, HEIGHT, WIDTH, package

pytestmark = pytest.mark.xdist_group("frames of web pages")  # One browser draws for all tests.


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    opened = Browser("webgpu")
    yield opened
    opened.close()


def drawn(browser: Browser, whole: dict[str, Any], count: int = 1) -> list[FrameTexels]:
    request = {"whole": whole, "count": count, "outputs": ["picture"]}
    return list(browser.draw_package(request))


def test_the_package_made_by_hand_is_complete() -> None:
    assert to_json(read(Package, package())) == package()


def test_a_plan_made_by_hand(browser: Browser) -> None:
    one, two = drawn(browser, package(), 2)
    assert (one.width, one.height, one.layers) == (WIDTH, HEIGHT, 1)
    first = np.frombuffer(one.texels, "<f4").reshape(HEIGHT, WIDTH, 4)
    second = np.frombuffer(two.texels, "<f4").reshape(HEIGHT, WIDTH, 4)
    column, row = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    filled = np.stack([np.full_like(column, 3), column, row, np.ones_like(row)], -1)
    assert first.tolist() == (filled + 4).tolist()
    assert second.tolist() == (filled + 4 + 0.5 * (filled + 4)).tolist()


def changed(whole: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    """A copy in which one thing is different."""
    made = copy.deepcopy(whole)
    *steps, last = [int(step) if step.isdigit() else step for step in path.split("/")]
    at: Any = made
    for step in steps:
        at = at[step]
    at[last] = value
    return made


def other_version(what: str, version: int, known: int = 2) -> str:
    return (
        f"this host knows {what} of version {known}, and this one is of version {version}: make "
        "the package again with `frame_package`"
    )


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("package", 1, other_version("packages", 1)),
        ("plan/plan", 7, other_version("plans", 7)),
        ("shaders/1/reflection/format", 1, other_version("reflections", 1, 3)),
        ("shaders/0/texts", {}, "the package of ByHand has no texts for a browser"),
        ("values", {}, "ByHand needs a value for `glow`"),
        ("values/glow", 11, "`glow` is declared in 0..10: 11 is not"),
        ("size", [0, 2], "a texture of ByHand would have 0 x 2 texels"),
        ("plan/steps/2/buffers", [], "nobody gives Hand its `numbers`"),
        (
            "plan/steps/3/draws/0/uses/0/inputs/2/source/result", "doubled.others",
            "ByHand reads doubled.others, which nobody has written",
        ),
        ("plan/outputs/0/name", "other", "ByHand has no output `picture`"),
    ],
)  # fmt: skip
def test_packages_that_cannot_be_drawn(
    browser: Browser, path: str, value: Any, message: str
) -> None:
    with pytest.raises(DriverError) as error:
        drawn(browser, changed(package(), path, value))
    assert str(error.value) == message


def test_what_a_text_says_wrongly_is_told_with_its_place(browser: Browser) -> None:
    with pytest.raises(DriverError, match=r"the browser refuses a text of Hand:\n5:16: .*'glim'"):
        wrong = FILLED.replace("given.glow", "glim")
        drawn(browser, changed(package(), "shaders/0/texts/wgsl:webgpu/fragment/text", wrong))


def test_what_the_device_complains_about_is_told(browser: Browser) -> None:
    """A texture that is drawn to while it is read."""
    wrong = changed(package(), "plan/steps/3/draws/0/uses/0/inputs/0/source/texture", 2)
    with pytest.raises(DriverError, match="usage"):
        drawn(browser, wrong)
