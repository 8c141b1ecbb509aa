"""The graph of a frame: its steps, what they leave to each other, and where that is kept."""
