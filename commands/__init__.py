"""The commands of ``burnish``, one file for each; ``group.py`` registers them.

A command imports what it needs when it runs, so that starting the program stays fast.
"""
