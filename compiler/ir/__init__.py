"""The graph: types, hash-consed nodes, the builtin rows they call, and the verifier."""
