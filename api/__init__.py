"""The library: its entry points, and the records that they return."""
