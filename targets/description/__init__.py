"""The records that describe a language and its profiles, which ``legalise`` and ``emit`` read."""
