"""Everything about target languages: emission, their compilers, their drivers, conformance."""
