"""The largest errors that were found on each driver. ``tests/builtins/measure.py`` writes it.

``driver_accuracy.py`` says what it is for, and the manual shows it beside what specifications
promise.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...stdlib.builtins.accuracy import Error
from .driver_accuracy import Envelope

ENVELOPES: Mapping[str, Envelope] = {
    "lavapipe": Envelope(
        "llvmpipe (LLVM 15.0.6, 256 bits) Mesa 22.3.6 (LLVM 15.0.6)",
        {
            "div": Error(ulp=0.5),
            "sqrt": Error(ulp=0.5),
            "inversesqrt": Error(ulp=1.5),
            "exp": Error(ulp=2.9, ulp_by_operand=1.9),
            "exp2": Error(ulp=3.1),
            "log": Error(ulp=2, absolute=1.1e-07),
            "log2": Error(ulp=2, absolute=1.6e-07),
            "sin": Error(absolute=6.5e-08, absolute_by_operand=1.7e-08),
            "cos": Error(absolute=7.3e-08, absolute_by_operand=1.7e-08),
            "asin": Error(ulp=1, absolute=0.0004),
            "acos": Error(ulp=1, absolute=0.00016),
            "atan": Error(ulp=1, absolute=3.4e-06),
            "atan2": Error(ulp=1, absolute=3.4e-06),
            "tanh": Error(ulp=1, absolute=1.1e-07),
        },
    ),
    "swiftshader": Envelope(
        "SwiftShader Device (Subzero) SwiftShader driver 5.0.0",
        {
            "div": Error(ulp=0.5),
            "sqrt": Error(ulp=0.5),
            "inversesqrt": Error(ulp=1.5),
            "exp": Error(ulp=3.1, ulp_by_operand=2.1),
            "exp2": Error(ulp=2.9),
            "log": Error(ulp=2, absolute=1.2e-07),
            "log2": Error(ulp=2, absolute=1.8e-07),
            "sin": Error(absolute=0.00019, absolute_by_operand=8.8e-08),
            "cos": Error(absolute=0.00019, absolute_by_operand=9.5e-08),
            "asin": Error(ulp=1),
            "acos": Error(ulp=1, absolute=6.8e-05),
            "atan": Error(ulp=1, absolute=5.4e-08),
            "atan2": Error(ulp=1, absolute=8.1e-08),
            "tanh": Error(ulp=1, absolute=8.4e-08),
        },
    ),
    "llvmpipe": Envelope(
        "llvmpipe (LLVM 15.0.6, 256 bits) 4.5 (Core Profile) Mesa 22.3.6",
        {
            "div": Error(ulp=0.5),
            "sqrt": Error(ulp=0.5),
            "inversesqrt": Error(ulp=1.5),
            "exp": Error(ulp=2.9, ulp_by_operand=1.9),
            "exp2": Error(ulp=3.1),
            "log": Error(ulp=2, absolute=1.1e-07),
            "log2": Error(ulp=2, absolute=1.6e-07),
            "sin": Error(absolute=6.5e-08, absolute_by_operand=1.7e-08),
            "cos": Error(absolute=7.3e-08, absolute_by_operand=1.7e-08),
            "asin": Error(ulp=1, absolute=0.0004),
            "acos": Error(ulp=1, absolute=0.00016),
            "atan": Error(ulp=1, absolute=3.4e-06),
            "atan2": Error(ulp=1, absolute=3.4e-06),
            "tanh": Error(ulp=1, absolute=1.1e-07),
        },
    ),
    "webgpu": Envelope(
        "google, swiftshader Chromium 156.0.8078.79",
        {
            "div": Error(ulp=0.5),
            "sqrt": Error(ulp=0.5),
            "inversesqrt": Error(ulp=1.5),
            "exp": Error(ulp=3.1, ulp_by_operand=2.1),
            "exp2": Error(ulp=2.9),
            "log": Error(ulp=2, absolute=1.2e-07),
            "log2": Error(ulp=2, absolute=1.8e-07),
            "sin": Error(absolute=0.00019, absolute_by_operand=8.8e-08),
            "cos": Error(absolute=0.00019, absolute_by_operand=9.5e-08),
            "asin": Error(ulp=1),
            "acos": Error(ulp=1, absolute=6.8e-05),
            "atan": Error(ulp=1, absolute=5.4e-08),
            "atan2": Error(ulp=1, absolute=8.1e-08),
            "tanh": Error(ulp=1, absolute=8.4e-08),
        },
    ),
    "webgl2": Envelope(
        (
            "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) "
            "(0x0000C0DE)), SwiftShader driver) Chromium 156.0.8078.79"
        ),
        {
            "div": Error(ulp=0.5),
            "sqrt": Error(ulp=0.5),
            "inversesqrt": Error(ulp=1.5),
            "exp": Error(ulp=3.1, ulp_by_operand=2.1),
            "exp2": Error(ulp=2.9),
            "log": Error(ulp=2, absolute=1.2e-07),
            "log2": Error(ulp=2, absolute=1.8e-07),
            "sin": Error(absolute=0.00019, absolute_by_operand=8.8e-08),
            "cos": Error(absolute=0.00019, absolute_by_operand=9.5e-08),
            "asin": Error(ulp=1),
            "acos": Error(ulp=1, absolute=6.8e-05),
            "atan": Error(ulp=1, absolute=5.4e-08),
            "atan2": Error(ulp=1, absolute=8.1e-08),
            "tanh": Error(ulp=1, absolute=8.4e-08),
        },
    ),
}
"""The measured errors of each driver, by its name in routes."""
