"""What bindings in C and C++ have in common: statements, tables, and the words in them."""
