"""Mutants of Burnish's sources: does a conformance run notice that a line is wrong?

``python -m tests.mutants --help`` tells how to make them by hand, and ``test_mutants.py`` makes a
few. A mutant is a copy of the package with one small change. If the change alters a text or what a
driver is told, ``conform`` should call the result ``differs`` or ``failed``; one that it calls
``agrees`` is a survivor, which is either equivalent or shows a hole in the tests.
"""
