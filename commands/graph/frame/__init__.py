"""The graph of a frame: its steps, the results that they pass on, and where these are kept."""
