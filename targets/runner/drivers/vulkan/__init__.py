"""Draws by Vulkan, without a window, on the driver that it is told to take.

``python -m burnish.targets.runner.drivers.vulkan ICD`` is the worker; All modules but
``driver`` import the binding to Vulkan, which cannot be imported where there is no Vulkan loader:
that is why ``driver`` imports them late.
"""
