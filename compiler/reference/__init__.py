"""The reference: the meaning of programs, as functions of numbers and of whole pictures."""
