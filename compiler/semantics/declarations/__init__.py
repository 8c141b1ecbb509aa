"""What declarations say: parameters, textures, the host's blocks, transforms, contracts."""
