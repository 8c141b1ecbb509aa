"""Bevy: a material as an extension of its standard material, in WGSL and Rust."""
