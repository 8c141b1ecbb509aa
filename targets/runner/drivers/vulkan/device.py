"""Opens the Vulkan instance and the device, always with the validation layer."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any

import vulkan as vk

from ..choice import chosen
from ..device import Device, DriverError
from .errors import Messages, explained

VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation"
INSTALL_LAYER = "apt-get install -y --no-install-recommends vulkan-validationlayers"
EXTENSIONS = (vk.VK_EXT_DEBUG_UTILS_EXTENSION_NAME, vk.VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME)
API_VERSION = vk.VK_MAKE_VERSION(1, 1, 0)
"""The version that SPIR-V is made for, and the first one with viewports of negative height."""

HUNG = 3
"""The exit code of a process whose device does not finish."""


@dataclass(frozen=True, slots=True)
class Gpu:
    """An open device. Fields of type ``Any`` are handles or structures of Vulkan."""

    physical: Any
    device: Any
    queue: Any
    commands: Any
    """The only command buffer; use ``recording``."""
    fence: Any
    properties: Any
    """``VkPhysicalDeviceProperties``."""
    memory: Any
    """``VkPhysicalDeviceMemoryProperties``."""
    independent_blend: bool
    """True if each render target may have a blend mode of its own."""
    cube_arrays: bool
    """True if there are arrays of cubes."""
    draws_lines: bool
    """True if the edges of triangles can be drawn (the fill mode of lines)."""
    clamps_bias: bool
    """True if a depth bias can have a limit."""
    transform_feedback: bool
    """True if vertices can be captured."""
    multiview: bool
    """True if one draw can reach several views."""
    mixes_views: bool
    """True if a draw of several views may draw a triangle to the wrong one."""
    messages: Messages
    seconds: float
    """The seconds that one submission may take."""


def open_gpu(owned: ExitStack, seconds: float, wanted: str = "") -> Gpu:
    """Open the device that is wanted; ``owned`` gets everything that must be closed.

    Raises ``DriverError``, which says what is missing.
    """
    messages = Messages()
    with explained(messages):
        instance = _instance(owned, messages)
        found = vk.vkEnumeratePhysicalDevices(instance)
        described = [vk.vkGetPhysicalDeviceProperties(each) for each in found]
        names = [each.deviceName for each in described]
        hardware = [each.deviceType != vk.VK_PHYSICAL_DEVICE_TYPE_CPU for each in described]
        number = chosen(names, hardware, wanted)
        physical, properties = found[number], described[number]
        if properties.apiVersion < API_VERSION:
            raise DriverError(f"{properties.deviceName} has no Vulkan 1.1")
        features = vk.vkGetPhysicalDeviceFeatures(physical)
        family = _graphics_family(physical)
        captures, multiview = _captures(physical), _has_multiview(physical)
        extended = _extended_features(captures=captures, multiview=multiview)
        device = _device(owned, physical, family, features, extended, captures=captures)
        return Gpu(
            physical=physical,
            device=device,
            queue=vk.vkGetDeviceQueue(device, family, 0),
            commands=_commands(owned, device, family),
            fence=_fence(owned, device),
            properties=properties,
            memory=vk.vkGetPhysicalDeviceMemoryProperties(physical),
            independent_blend=bool(features.independentBlend),
            cube_arrays=bool(features.imageCubeArray),
            draws_lines=bool(features.fillModeNonSolid),
            clamps_bias=bool(features.depthBiasClamp),
            transform_feedback=captures,
            multiview=multiview,
            mixes_views=_mixes_views(properties),
            messages=messages,
            seconds=seconds,
        )


def _instance(owned: ExitStack, messages: Messages) -> Any:
    layers = {layer.layerName for layer in vk.vkEnumerateInstanceLayerProperties()}
    if VALIDATION_LAYER not in layers:
        raise DriverError(
            f"{VALIDATION_LAYER} is missing, and nothing is drawn without it; "
            f"to install it: {INSTALL_LAYER}"
        )
    messenger = messages.create_info()
    validation = vk.VkValidationFeaturesEXT(
        pNext=messenger,  # for what happens before there is a messenger, and after it
        pEnabledValidationFeatures=[vk.VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT],
    )
    application = vk.VkApplicationInfo(pApplicationName="burnish", apiVersion=API_VERSION)
    info = vk.VkInstanceCreateInfo(
        pNext=validation,
        pApplicationInfo=application,
        ppEnabledLayerNames=[VALIDATION_LAYER],
        ppEnabledExtensionNames=EXTENSIONS,
    )
    instance = vk.vkCreateInstance(info, None)
    owned.callback(vk.vkDestroyInstance, instance, None)
    create = vk.vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT")
    destroy = vk.vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT")
    owned.callback(destroy, instance, create(instance, messenger, None), None)
    return instance


def _graphics_family(physical: Any) -> int:
    families = vk.vkGetPhysicalDeviceQueueFamilyProperties(physical)
    for index, family in enumerate(families):
        if family.queueFlags & vk.VK_QUEUE_GRAPHICS_BIT:
            return index
    raise DriverError("the device has no queue for graphics")


def _captures(physical: Any) -> bool:
    """True if the device has the extension that captures vertices."""
    offered = vk.vkEnumerateDeviceExtensionProperties(physical, None)
    names = {each.extensionName for each in offered}
    return vk.VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME in names


def _has_multiview(physical: Any) -> bool:
    """True if one draw can reach several views, which Vulkan 1.1 leaves to the device."""
    views = vk.ffi.new("VkPhysicalDeviceMultiviewFeatures*")
    views.sType = vk.VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES
    features = vk.ffi.new("VkPhysicalDeviceFeatures2*")
    features.sType = vk.VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2
    features.pNext = views
    vk.vkGetPhysicalDeviceFeatures2(physical, features)
    return bool(views.multiview)


def _mixes_views(properties: Any) -> bool:
    """True for lavapipe, which draws what it has to clip to the last of several views."""
    name: str = properties.deviceName
    return name.startswith("llvmpipe")


def _extended_features(*, captures: bool, multiview: bool) -> Any:
    """The chain of the features beyond those of Vulkan 1.0; ``None`` if there are none."""
    chain = None
    if captures:
        chain = vk.VkPhysicalDeviceTransformFeedbackFeaturesEXT(transformFeedback=True)
    if multiview:
        chain = vk.VkPhysicalDeviceMultiviewFeatures(pNext=chain, multiview=True)
    return chain


def _device(
    owned: ExitStack,
    physical: Any,
    family: int,
    offered: Any,
    extended: Any,
    *,
    captures: bool,
) -> Any:
    queue = vk.VkDeviceQueueCreateInfo(queueFamilyIndex=family, pQueuePriorities=[1.0])
    features = vk.VkPhysicalDeviceFeatures(
        independentBlend=offered.independentBlend,
        fillModeNonSolid=offered.fillModeNonSolid,
        depthBiasClamp=offered.depthBiasClamp,
        geometryShader=offered.geometryShader,
        tessellationShader=offered.tessellationShader,
        imageCubeArray=offered.imageCubeArray,
    )
    info = vk.VkDeviceCreateInfo(
        pNext=extended,
        pQueueCreateInfos=[queue],
        pEnabledFeatures=features,
        ppEnabledExtensionNames=[vk.VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME] if captures else [],
    )
    device = vk.vkCreateDevice(physical, info, None)
    owned.callback(vk.vkDestroyDevice, device, None)
    return device


def _commands(owned: ExitStack, device: Any, family: int) -> Any:
    pool_info = vk.VkCommandPoolCreateInfo(
        flags=vk.VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, queueFamilyIndex=family
    )
    pool = vk.vkCreateCommandPool(device, pool_info, None)
    owned.callback(vk.vkDestroyCommandPool, device, pool, None)
    info = vk.VkCommandBufferAllocateInfo(
        commandPool=pool, level=vk.VK_COMMAND_BUFFER_LEVEL_PRIMARY, commandBufferCount=1
    )
    return vk.vkAllocateCommandBuffers(device, info)[0]


def _fence(owned: ExitStack, device: Any) -> Any:
    fence = vk.vkCreateFence(device, vk.VkFenceCreateInfo(), None)
    owned.callback(vk.vkDestroyFence, device, fence, None)
    return fence


def describe(gpu: Gpu) -> Device:
    """The device's description of itself."""
    limits = gpu.properties.limits
    return Device(
        name=gpu.properties.deviceName,
        version=_driver_version(gpu),
        subpixel_bits=limits.subPixelPrecisionBits,
        subtexel_bits=limits.subTexelPrecisionBits,
        mip_bits=limits.mipmapPrecisionBits,
        lines="rectangle" if limits.strictLines else None,
    )


def _driver_version(gpu: Gpu) -> str:
    """The driver's own name of its version; drivers may have one since Vulkan 1.2."""
    driver = vk.ffi.new("VkPhysicalDeviceDriverProperties*")
    driver.sType = vk.VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES
    properties = vk.ffi.new("VkPhysicalDeviceProperties2*")
    properties.sType = vk.VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2
    if gpu.properties.apiVersion >= vk.VK_MAKE_VERSION(1, 2, 0):
        properties.pNext = driver
    vk.vkGetPhysicalDeviceProperties2(gpu.physical, properties)
    name, info = (vk.ffi.string(text).decode() for text in (driver.driverName, driver.driverInfo))
    return info or f"{name} {_numbers(gpu.properties.driverVersion)}".strip()


def _numbers(version: int) -> str:
    """A version number as most drivers pack it, and Vulkan itself: 10, 10 and 12 bits."""
    return f"{version >> 22}.{version >> 12 & 0x3FF}.{version & 0xFFF}"


@contextmanager
def recording(gpu: Gpu) -> Iterator[Any]:
    """Yield a command buffer to record into; then run it and wait until it has finished."""
    vk.vkResetCommandBuffer(gpu.commands, 0)
    once = vk.VkCommandBufferBeginInfo(flags=vk.VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT)
    vk.vkBeginCommandBuffer(gpu.commands, once)
    yield gpu.commands
    vk.vkEndCommandBuffer(gpu.commands)
    gpu.messages.check()
    submit = vk.VkSubmitInfo(pCommandBuffers=[gpu.commands])
    vk.vkQueueSubmit(gpu.queue, 1, [submit], gpu.fence)
    try:
        vk.vkWaitForFences(gpu.device, 1, [gpu.fence], True, int(gpu.seconds * 1e9))
    except vk.VkTimeout:
        _give_up(gpu.seconds)
    vk.vkResetFences(gpu.device, 1, [gpu.fence])


def _give_up(seconds: float) -> None:
    """End the process at once, because objects that the device still uses cannot be destroyed."""
    print(f"the device did not finish drawing within {seconds:g} s", file=sys.stderr, flush=True)
    os._exit(HUNG)
