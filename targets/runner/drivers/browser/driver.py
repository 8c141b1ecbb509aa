"""The driver for browsers: a page in Chromium that draws.

The first request opens the browser, and so does the first one after the page was lost.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ....toolchain.tools import tool_named
from ..capture_job import Captured, CaptureJob
from ..checks import check, check_capture, check_kernel, check_names
from ..device import Device, DriverError
from ..draw_job import Draw, Job, Picture
from ..frame_job import FrameTexels
from ..kernel_job import Dispatch, KernelJob, Written
from ..pipeline import Pipeline
from ..readback import to_float
from ..render_state import TargetFormat
from ..wire import from_json, to_json

if TYPE_CHECKING:
    from .chromium import Chromium


APIS: Mapping[str, str] = {"webgpu": "webgpu.mjs", "webgl2": "webgl2.mjs"}
"""The APIs of a web page, each with the module that draws with it."""


class Browser:
    """Draws with one of the browser's APIs."""

    def __init__(self, module: str) -> None:
        self._module = module
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

    def draw(self, job: Job) -> Sequence[Picture]:
        """A picture for each draw of the job. Raises ``DriverError``."""
        check(job)
        check_names(job.pipeline)
        drawn = self._ask("draw", to_json(job))["pictures"]
        return [
            _picture(job.pipeline, draw, targets)
            for draw, targets in zip(job.draws, drawn, strict=True)
        ]

    def compute(self, job: KernelJob) -> Sequence[Written]:
        """What each dispatch of the job writes. Raises ``DriverError``."""
        check_kernel(job)
        runs = self._ask("kernel", to_json(job))["written"]
        return [_written(job, *each) for each in zip(job.dispatches, runs, strict=True)]

    def capture(self, job: CaptureJob) -> Sequence[Captured]:
        """The vertices that each draw of the job captures. Raises ``DriverError``."""
        check_capture(job)
        check_names(job.pipeline)
        found = self._ask("capture", to_json(job))["captured"]
        return [Captured(row["count"], base64.b64decode(row["data"])) for row in found]

    def draw_package(self, request: Mapping[str, Any]) -> Sequence[FrameTexels]:
        """What the outputs of a frame show, frame after frame. Raises ``DriverError``."""
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
        self._chromium = Chromium(self._module)
        return self._chromium


def _picture(pipeline: Pipeline, draw: Draw, targets: Sequence[Mapping[str, str]]) -> Picture:
    """The picture of the texels that the page returns in base64, with their formats."""
    return Picture(draw.width, draw.height, tuple(_floats(pipeline, draw, t) for t in targets))


def _written(job: KernelJob, dispatch: Dispatch, run: Mapping[str, Any]) -> Written:
    """What the page returns in base64, with texels in their formats."""
    width, height, _ = dispatch.extent
    images = (
        to_float(base64.b64decode(texels), slot.format, width, height, "top")
        for slot, texels in zip(job.pipeline.images, run["images"], strict=True)
    )
    return Written(tuple(map(base64.b64decode, run["buffers"])), tuple(images))


def _floats(pipeline: Pipeline, draw: Draw, target: Mapping[str, Any]) -> bytes:
    stored: TargetFormat = target["format"]
    texels = base64.b64decode(target["texels"])
    return to_float(texels, stored, draw.width, draw.height, pipeline.first_row)
