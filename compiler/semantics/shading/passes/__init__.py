"""The members of passes: their targets, layers and captures, and the state of the pipeline."""
