"""Draws with the Python package ``wgpu``: WebGPU on Direct3D 12, Metal or Vulkan.

``python -m burnish.targets.runner.drivers.wgpu [DEVICE]`` is the worker process. All modules but
``driver`` import the package, which is optional. So ``driver`` imports them only when it needs
them.
"""
