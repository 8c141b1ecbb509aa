"""Finds the devices of the machine, and opens one."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import wgpu

from ..choice import chosen
from ..device import Device, DriverError

BACKENDS = ("D3D12", "Metal", "Vulkan")
"""The APIs that wgpu may draw with. Its OpenGL cannot do all that a job may ask for."""

FEATURES = ("float32-blendable", "float32-filterable", "depth32float-stencil8")
"""The features for float32 targets and textures, and for stencil values beside float32 depths."""

LIMITS = (
    "max-color-attachment-bytes-per-sample",
    "max-sampled-textures-per-shader-stage",
    "max-samplers-per-shader-stage",
)
"""The limits of which the device gets all that the adapter has: several float32 targets exceed the
default of the first one, and materials may have more textures than all devices."""

SUBPIXEL_BITS = 8
"""The binary places to which vertices are snapped, which WebGPU does not report. Direct3D 12
demands 8 bits, and so do Metal's GPUs and Mesa."""


LOST = "device is lost"
"""The words of all errors after a device was lost; the package has no class for them."""


class DeviceLostError(DriverError):
    """The device must be opened again."""


@dataclass(frozen=True, slots=True)
class Gpu:
    """An open device. Fields of type ``Any`` are objects of the package ``wgpu``."""

    device: Any
    features: frozenset[str]
    description: Device


def open_gpu(wanted: str) -> Gpu:
    """Open the device that somebody asks for. Raises ``DriverError``."""
    with explained():
        found = wgpu.gpu.enumerate_adapters_sync()
    adapters = [each for each in found if each.info["backend_type"] in BACKENDS]
    names = [_title(each) for each in adapters]
    hardware = [each.info["adapter_type"] != "CPU" for each in adapters]
    adapter = adapters[chosen(names, hardware, wanted)]
    features = [feature for feature in FEATURES if feature in adapter.features]
    limits = {name: int(adapter.limits[name]) for name in LIMITS}
    with explained():
        device = adapter.request_device_sync(required_features=features, required_limits=limits)
    # WebGPU reports neither the precision of texture filters nor the driver's own version.
    version = f"{adapter.info['description']}, wgpu {wgpu.__version__}".removeprefix(", ")
    description = Device(_title(adapter), version, SUBPIXEL_BITS, subtexel_bits=0, mip_bits=0)
    return Gpu(device, frozenset(features), description)


def _title(adapter: Any) -> str:
    return f"{adapter.info['device']} by {adapter.info['backend_type']}"


@contextmanager
def explained() -> Iterator[None]:
    """Turn the package's errors into ``DriverError``."""
    try:
        yield
    except (wgpu.GPUError, RuntimeError) as error:
        kind = DeviceLostError if LOST in str(error).lower() else DriverError
        raise kind(str(error)) from error
