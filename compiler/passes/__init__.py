"""From the graph that semantics leaves to programs that backends print; see ``pipeline``."""
