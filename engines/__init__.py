"""Puts functions into engines: a folder for each engine, as languages have one each."""
