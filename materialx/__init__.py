"""MaterialX documents come in as materials, and are compared with MaterialX's own texts."""
