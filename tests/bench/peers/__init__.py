"""Other compilers of shaders, which are measured beside Burnish if they are installed.

They are dependencies of the bench alone: ``make bench`` installs the extra ``bench`` where pip has
packages for the machine. ``race.py`` asks each of them for the texts of one material, new each
time.
"""
