"""``python -m burnish`` is the command ``burnish``."""

from .commands.cli import main

main()
