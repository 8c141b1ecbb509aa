"""Decides whether two programs mean the same: by algebra, by points, and by bounds of boxes.

``burnish same`` calls ``comparing.py``. All of it needs NumPy, so nothing that compiles imports it.
"""
