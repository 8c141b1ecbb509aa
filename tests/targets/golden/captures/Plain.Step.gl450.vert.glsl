#version 450 core
// Plain: vertex shader, by Burnish.

layout(xfb_buffer = 0, xfb_stride = 12) out;

layout(location = 2) in vec2 vertex_uv;

layout(location = 0, xfb_offset = 0) flat out int v_number;
layout(location = 1, xfb_offset = 4) out vec2 v_place;

void main() {
    v_number = int(uint(gl_VertexID));
    v_place = vertex_uv;
}
