"""The modules of the host for web pages, as pages load them, with the one that is computed."""
