"""What Mesa's drivers for the CPU are told. Workers that may use them set it when they start."""

from __future__ import annotations

SETTINGS = {
    # Its fast path for rgba8 textures rounds a filter's weights and sums to 8 bits, which is wrong
    # by up to 1.5 steps of the texture; the general path is exact to 4e-7. Its other approximations
    # (brilinear, rho_approx) are off by default.
    "GALLIVM_PERF": "no_aos_sampling",
    # The number of rasterising threads. Most time is spent on compiling shaders, which takes one
    # thread in any case, and there is a worker for each core.
    "LP_NUM_THREADS": "1",
}
"""The variables that Mesa's software driver reads when it starts; other drivers ignore them."""
