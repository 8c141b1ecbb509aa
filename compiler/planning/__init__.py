"""Plans: what a host does to draw a frame, in order, and which memory it needs for that."""
