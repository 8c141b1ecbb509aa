"""Vulkan's result codes and the validation layer's words, as ``DriverError``."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import vulkan as vk

from ..draw import DriverError

SEVERITIES = (
    vk.VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT
    | vk.VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT
)
TYPES = (
    vk.VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT
    | vk.VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT
    | vk.VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT
)

VALIDATION_FAILED = -1000011001
"""``VK_ERROR_VALIDATION_FAILED_EXT``, of which the binding does not know that calls return it."""

WORDS: dict[type[Exception], str] = {
    vk.VkErrorOutOfHostMemory: "there is not enough memory",
    vk.VkErrorOutOfDeviceMemory: "there is not enough memory on the device",
    vk.VkErrorIncompatibleDriver: "the loader finds no driver that it can use",
    vk.VkErrorInitializationFailed: "the driver could not be started",
    vk.VkErrorExtensionNotPresent: "the driver lacks an extension that is needed",
    vk.VkErrorFormatNotSupported: "the driver lacks a format that is needed",
}
"""What to say of result codes that a user can do something about."""


class DeviceLostError(DriverError):
    """The device has to be opened anew."""


class RefusedError(vk.VkError):  # type: ignore[misc]
    """The validation layer kept a call from the driver."""


vk.exception_codes[VALIDATION_FAILED] = RefusedError


class Messages:
    """What the validation layer has complained of since the last look."""

    def __init__(self) -> None:
        self._texts: list[str] = []

    def create_info(self) -> Any:
        """A ``VkDebugUtilsMessengerCreateInfoEXT`` for what is at least a warning."""
        return vk.VkDebugUtilsMessengerCreateInfoEXT(
            messageSeverity=SEVERITIES, messageType=TYPES, pfnUserCallback=self._receive
        )

    def check(self) -> None:
        """Raises ``DriverError`` with all that was said, and forgets it."""
        if self._texts:
            texts, self._texts = self._texts, []
            raise DriverError("\n".join(texts))

    def _receive(self, _severity: int, _type: int, data: Any, _user: Any) -> int:
        """Returns that the call is not to reach the driver, which might not survive it."""
        self._texts.append(vk.ffi.string(data.pMessage).decode(errors="replace"))
        return int(vk.VK_TRUE)


@contextmanager
def explained(messages: Messages) -> Iterator[None]:
    """Raises ``DriverError`` for failed calls, and for messages even when no call failed."""
    try:
        yield
    except vk.VkErrorDeviceLost as error:
        raise DeviceLostError("the device was lost") from error
    except vk.VkError as error:
        messages.check()
        name = type(error).__name__
        raise DriverError(WORDS.get(type(error), f"a call of the driver failed: {name}")) from error
    messages.check()
