"""Documents of MaterialX: what they mean in Burnish."""
