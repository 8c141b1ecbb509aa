"""Bindings: what a host needs of compiled materials, written in the host's own language.

``model`` has the records of a binding, which are the same for all languages. ``gathering`` makes
them of reflections and plans, ``derivation`` turns the steps of derived values into expressions,
and ``writing`` fills the skeleton of a language in. A language is a folder here that has a
``language.py`` (``registry``).
"""
