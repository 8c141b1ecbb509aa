"""Declarations: parameters, textures, the host's blocks, transforms, contracts."""
