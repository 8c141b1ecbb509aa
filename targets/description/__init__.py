"""What is said about each language and its profiles: rows that ``legalise`` and ``emit`` read."""
