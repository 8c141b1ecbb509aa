"""The documents that Burnish writes for hosts, as records: reflections and plans.

A document is declared once, by the classes here. Their docstrings are its documentation, and
``writing`` makes JSON of them, ``reading`` checks JSON and makes records of it, ``schema`` makes
their JSON Schemas, and ``typescript`` their types for web pages.
"""
