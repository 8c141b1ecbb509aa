"""The page of ``burnish view``: what it shows beside the picture, and its files."""
