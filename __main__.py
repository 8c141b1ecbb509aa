"""``python -m burnish`` is the command ``burnish``."""

from .cli import main

main()
