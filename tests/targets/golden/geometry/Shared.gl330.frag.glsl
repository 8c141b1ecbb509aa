#version 330 core
// Shared: fragment shader, by Burnish.
// Fins on some triangles, and some more on all.

layout(location = 0) out vec4 out_color;

void main() {
    out_color = vec4(0.8, 0.8, 0.8, 1.0);
}
