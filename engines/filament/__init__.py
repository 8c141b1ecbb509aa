"""Filament: a material as a material definition, which its compiler ``matc`` takes."""
