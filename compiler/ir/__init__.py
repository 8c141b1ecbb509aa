"""The graph: its types, nodes and operations, and the analyses that several phases share."""
