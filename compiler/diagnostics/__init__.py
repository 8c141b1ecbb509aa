"""Diagnostics are data: a row of the table, a span and arguments; renderers stand apart."""
