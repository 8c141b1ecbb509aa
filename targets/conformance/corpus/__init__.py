"""The corpus: for each operation of the language, operands, results, and which results conform.

``burnish corpus`` writes it as JSON, for other people's compilers, interpreters and backends: they
can test their arithmetic without a GPU. All of it follows from the rows of the builtins
(``stdlib/builtins``), so a new row has its file without a change here.
"""
