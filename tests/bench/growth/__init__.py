"""The growth of a compile's work with its input: doubling sizes of many shapes of programs.

``python -m tests.bench growth`` prints the exponent of growth for each shape and phase: 1 is
linear, 2 quadratic. ``shape`` declares what a shape is; ``declarations``, ``graphs``, ``texts`` and
``mistakes`` hold the generators; ``measure`` makes the table. ``tests/bench/worker.py`` is the
process that compiles.
"""
