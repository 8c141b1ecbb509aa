"""The state of the elaboration of one shader."""
