"""Draws with Vulkan, without a window, on the driver that it is told to use.

``python -m burnish.targets.runner.drivers.vulkan ICD`` is the worker process. All modules but
``driver`` import the Python binding of Vulkan, which fails if there is no Vulkan loader. So
``driver`` imports them only when it needs them.
"""
