"""Settings of Mesa's drivers for the CPU. Workers that may use them set them when they start."""

from __future__ import annotations

SETTINGS = {
    # - no_aos_sampling: the fast path for rgba8 textures rounds a filter's weights and sums to 8
    #   bits, which is wrong by up to 1.5 steps of the texture; the general path is exact to 4e-7.
    #   The other approximations (brilinear, rho_approx, quad_lod) are off by default. Even so, the
    #   level is found with an approximate logarithm, which is wrong by up to 0.043.
    # - nopt: LLVM generates machine code without optimising. Pictures are small, so that most time
    #   is spent on compiling, and this takes half of it. Every bit of the pictures is the same.
    "GALLIVM_PERF": "no_aos_sampling,nopt",
    # The number of rasterising threads. Compiling takes one thread in any case, and there is a
    # worker for each core.
    "LP_NUM_THREADS": "1",
}
"""The variables that Mesa's software drivers read when they start; other drivers ignore them."""
