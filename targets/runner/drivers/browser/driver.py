"""The driver for browsers: a page in Chromium that draws with the host for web pages.

The first request opens the browser, and so does the first one after the page was lost.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ....toolchain.tools import tool_named
from ..checks import check_groups, check_names
from ..device import Device, DriverError
from ..frame_job import Found, FrameJob, FrameTexels
from ..wire import from_json
from .job_document import WGSL, document_of

if TYPE_CHECKING:
    from .chromium import Chromium


APIS: Mapping[str, str] = {"webgpu": WGSL, "webgl2": "glsl:es300"}
"""The APIs of a web page, each with the profile whose texts it takes. A module of the API's name
draws with it."""


class Browser:
    """Draws with one of the browser's APIs."""

    def __init__(self, api: str) -> None:
        """``api`` is a key of ``APIS``."""
        self._api = api
        self._chromium: Chromium | None = None

    def device(self) -> Device:
        """The page's description of its device, and the browser's version."""
        said = self._ask("device", None)
        assert self._chromium is not None
        # Neither API reports the precision of texture filters.
        return Device(
            name=said["name"],
            version=f"Chromium {self._chromium.version}",
            subpixel_bits=said["subpixel_bits"],
            subtexel_bits=0,
            mip_bits=0,
        )

    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back. Raises ``DriverError``."""
        check_names(job)
        check_groups(job, lambda: [self._ask("device", None)["most_groups"]] * 3)
        return from_json(Found, self._ask("job", document_of(job, APIS[self._api])))

    def draw_package(self, request: Mapping[str, Any]) -> Sequence[FrameTexels]:
        """Draw frames of a package: returns the texels of their outputs. Raises ``DriverError``."""
        return [from_json(FrameTexels, row) for row in self._ask("frames", request)["texels"]]

    def close(self) -> None:
        """End the browser, if there is one."""
        if self._chromium is not None:
            self._chromium.close()
            self._chromium = None

    def _ask(self, function: str, argument: Any) -> Mapping[str, Any]:
        """Call a function of the page's module. Raises ``DriverError``."""
        chromium = self._chromium or self._open()
        try:
            answer = chromium.call(function, json.dumps(argument))
        except DriverError:
            self.close()
            raise
        if answer.get("lost"):
            self.close()
        if "error" in answer:
            raise DriverError(answer["error"])
        return answer

    def _open(self) -> Chromium:
        try:
            from .chromium import Chromium
        except ImportError as error:
            install = tool_named("playwright").install
            raise DriverError(f"{error}; to install it: {install}") from None
        self._chromium = Chromium(f"{self._api}.mjs")
        return self._chromium
