"""The page of ``burnish view``: its controls, its first camera, and its files."""
