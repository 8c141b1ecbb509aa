"""Frames: steps that draw and compute, put together."""
