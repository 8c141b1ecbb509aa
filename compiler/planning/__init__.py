"""Plans: the steps of a host that draws a frame, in order, and the memory for them."""
