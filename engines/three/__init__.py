"""Materials for three.js: modules of functions in WGSL and GLSL for its node materials."""
