"""The costs of Burnish: instructions of its shaders, time of its compiles, time a node.

``make bench`` prints the tables and writes ``build/bench.json``. Nothing here passes or fails:
times depend on the machine, so what is compared is measured in the same run.
"""
