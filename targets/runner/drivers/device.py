"""The description that a driver gives of its device, and the error of a driver that cannot draw."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True)
class Device:
    """A driver's description of itself."""

    name: str
    """For example ``llvmpipe (LLVM 15.0.6, 256 bits)``."""
    version: str
    """The driver's version, for example ``Mesa 22.3.6``."""
    subpixel_bits: int
    """The binary places of a pixel to which vertices are snapped."""
    subtexel_bits: int
    """The binary places of a linear filter's weights; 0 if the API does not tell."""
    mip_bits: int
    """The binary places of the weights between mip levels; 0 if the API does not tell."""
    lines: Literal["rectangle"] | None = None
    """The area that a line covers; ``None`` if the API does not tell, or does not know.

    Vulkan's conformance tests let lines that are not strict be parallelograms or follow diamonds.
    """

    @property
    def title(self) -> str:
        """The name and the version, for people."""
        return f"{self.name}, {self.version}"


class DriverError(Exception):
    """A driver could not draw; the text tells people why."""


class EndedError(DriverError):
    """A driver's process has crashed, or somebody has killed it, before it has answered."""
