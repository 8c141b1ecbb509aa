"""Equations of a material as their author knows them: nodes of what is written, for pictures."""
