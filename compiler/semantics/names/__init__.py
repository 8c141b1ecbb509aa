"""Files, their imports, and the names that each file can see."""
