"""From a program that knows no language to the form in which one profile prints it."""
