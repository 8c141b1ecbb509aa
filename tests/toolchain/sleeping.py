"""A worker that says that it runs, and then works for long in native code."""

from __future__ import annotations

import ctypes

if __name__ == "__main__":
    print("started", flush=True)
    ctypes.CDLL(None).sleep(600)
