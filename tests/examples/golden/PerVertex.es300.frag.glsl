#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// PerVertex: fragment shader, by Burnish.
// Per vertex, after Gouraud: the colour is computed at the vertices and interpolated.

in vec3 v_color;

layout(location = 0) out vec4 out_color;

void main() {
    out_color = vec4(v_color, 1.0);
}
