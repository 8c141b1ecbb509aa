#version 450 core
// Tent: fragment shader, by Burnish.
// A roof over each triangle, walls around it, and a flag on every third one.

layout(location = 0) in vec2 v_uv;
layout(location = 1) flat in int v_part;

layout(location = 0) out vec4 out_color;

void main() {
    vec3 color = vec3(v_uv, float(v_part));
    out_color = vec4(color, 1.0);
}
