"""Turns Vulkan's result codes and the validation layer's messages into ``DriverError``."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import vulkan as vk

from ..device import DriverError

SEVERITIES = (
    vk.VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT
    | vk.VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT
)
TYPES = (
    vk.VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT
    | vk.VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT
    | vk.VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT
)

HARMLESS = (
    # A compiler may find out that a fragment shader does not need one of its inputs, for instance
    # because it discards all fragments.
    ("OutputNotConsumed ]", "consumed by fragment shader"),
    # Mesa warns about a decoration that SPIR-V allows, and obeys it: glslang makes the position a
    # member of a block.
    ("Decoration not allowed on struct members: SpvDecorationInvariant",),
)
"""The parts of each message that is no fault of a shader."""

VALIDATION_FAILED = -1000011001
"""``VK_ERROR_VALIDATION_FAILED_EXT``, which the Python binding does not know as a result code."""

WORDS: dict[type[Exception], str] = {
    vk.VkErrorOutOfHostMemory: "there is not enough memory",
    vk.VkErrorOutOfDeviceMemory: "there is not enough memory on the device",
    vk.VkErrorIncompatibleDriver: "the loader finds no driver that it can use",
    vk.VkErrorInitializationFailed: "the driver could not be started",
    vk.VkErrorExtensionNotPresent: "the driver lacks an extension that is needed",
    vk.VkErrorFormatNotSupported: "the driver lacks a format that is needed",
}
"""Messages for result codes about which a user can do something."""
NO_MEMORY = (vk.VkErrorOutOfHostMemory, vk.VkErrorOutOfDeviceMemory)
"""The result codes of which drivers have nothing to say but the code's name."""


class DeviceLostError(DriverError):
    """The device must be opened again."""


class RefusedError(vk.VkError):  # type: ignore[misc]
    """The validation layer has stopped a call before it reached the driver."""


vk.exception_codes[VALIDATION_FAILED] = RefusedError


class Messages:
    """The messages of the validation layer since they were last checked."""

    def __init__(self) -> None:
        self._texts: list[str] = []

    def create_info(self) -> Any:
        """A ``VkDebugUtilsMessengerCreateInfoEXT`` for warnings and errors."""
        return vk.VkDebugUtilsMessengerCreateInfoEXT(
            messageSeverity=SEVERITIES, messageType=TYPES, pfnUserCallback=self._receive
        )

    def forget(self) -> None:
        """Forget all messages."""
        self._texts.clear()

    def check(self, before: str = "") -> None:
        """Raise ``DriverError`` with all messages, if there are any, and forget them.

        ``before`` is a line that begins the error.
        """
        if self._texts:
            texts, self._texts = self._texts, []
            raise DriverError("\n".join((before, *texts) if before else texts))

    def _receive(self, _severity: int, _type: int, data: Any, _user: Any) -> int:
        """The result stops the call: the driver might crash if it got it."""
        text = vk.ffi.string(data.pMessage).decode(errors="replace")
        if any(all(part in text for part in parts) for parts in HARMLESS):
            return int(vk.VK_FALSE)
        self._texts.append(text)
        return int(vk.VK_TRUE)


@contextmanager
def explained(messages: Messages, before: str = "") -> Iterator[None]:
    """Raise ``DriverError`` for failed calls, and for messages even if no call failed.

    ``before`` is that of ``Messages.check``.
    """
    try:
        yield
    except vk.VkErrorDeviceLost as error:
        raise DeviceLostError("the device was lost") from error
    except vk.VkError as error:
        if isinstance(error, NO_MEMORY):
            messages.forget()
        messages.check(before)
        name = type(error).__name__
        raise DriverError(WORDS.get(type(error), f"a call of the driver failed: {name}")) from error
    messages.check(before)
