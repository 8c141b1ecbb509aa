"""Helpers of all floors that know nothing of shaders: records, arguments, memory, the stack."""
