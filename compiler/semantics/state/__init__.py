"""What the elaboration of one shader has built so far."""
