"""What all backends share: names, bindings, expressions, statements, skeletons."""
