"""Materials of Burnish as documents of MaterialX: the converse of importing."""
