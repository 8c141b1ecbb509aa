"""Makes the reflection of a compiled material: all that a host needs to draw with it."""

from .reflect import reflect

__all__ = ["reflect"]
