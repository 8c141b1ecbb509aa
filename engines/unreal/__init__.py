"""Unreal Engine: a material as functions for Custom nodes of its material editor."""
