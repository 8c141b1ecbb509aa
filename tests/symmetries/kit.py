"""Pictures of whole frames by the reference, for tests that compare one picture with another."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

import burnish
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import Scenery

Floats = NDArray[np.float64]


def drawn(text: str, scenery: Scenery, size: int, values: Mapping[str, object]) -> Floats:
    """The picture (height, width, lanes) of the output ``picture`` of the only frame of a text."""
    (frame,) = burnish.compile(text, ("wgsl",)).frames
    host = FrameHost(frame, scenery, (size, size))
    for name, value in values.items():
        host.set(name, value)
    drawing = ReferenceFrames(host)
    drawing.draw()
    (level, *_) = drawing.output("picture").levels
    return np.asarray(level[0, 0])
