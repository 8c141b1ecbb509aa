"""The reference: what programs mean, as functions of numbers and of whole pictures."""
