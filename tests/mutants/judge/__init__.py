"""A program that is told of mutants, one after the other, and says whether each is noticed.

``copies.py`` starts it as ``python -m judge FOLDER …``, beside a copy of the package. It answers
one line of JSON on its standard input with one on its output: ``Question`` in ``questions.py`` says
what it is asked. It imports nothing of the tests outside of this folder, as the copy does not have
them. The package is only imported within functions, by a process for each question: so each answer
is about what is in the copy then.
"""
