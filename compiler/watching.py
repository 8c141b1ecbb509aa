"""The variables of the environment with which people and tests watch what passes do.

Then a compile has to do all its work: nothing is taken from what was remembered.
"""

from __future__ import annotations

import os

VARIABLE = "BURNISH_VERIFY"
"""Set to ``1`` in all tests; off for users, since verifying costs as much as a pass."""
SHOWN = "BURNISH_SHOW"
"""Names of passes, with commas between them, or ``all``."""


def is_watched() -> bool:
    """True if passes are verified or printed, so that each compile has to run them."""
    return os.environ.get(VARIABLE) == "1" or bool(os.environ.get(SHOWN))
