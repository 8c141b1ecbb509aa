#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Vignette: vertex shader, by Burnish.
// Darkens the corners of a picture.

void main() {
    gl_Position = vec4(uint(gl_VertexID) == 1u ? 3.0 : -1.0, uint(gl_VertexID) == 2u ? 3.0 : -1.0, 0.0, 1.0);
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
