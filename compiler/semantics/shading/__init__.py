"""A material, a pass and a rig put together into a shader."""
