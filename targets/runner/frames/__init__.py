"""Draws frames: executes their plans with the reference and with drivers."""
