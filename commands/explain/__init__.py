"""``burnish explain``: explains the code of a diagnostic, and shows it by two programs.

The programs are in a file for each section of the codes.
"""

from .command import explain

__all__ = ["explain"]
