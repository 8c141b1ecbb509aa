"""Engines that light surfaces themselves: a folder for each, which makes its files of functions."""
