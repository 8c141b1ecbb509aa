#version 450
// Sparks: geometry shader, by Burnish.
// Every spark that is young enough becomes two.

layout(std140, set = 2, binding = 0) uniform Material {
    vec3 wind;
};

layout(points) in;
layout(points, max_vertices = 2) out;

layout(xfb_buffer = 0, xfb_stride = 20) out;

layout(location = 0) in vec4 v_position_older[];

layout(location = 0, xfb_offset = 0) out vec3 v_position;  /// In world space
layout(location = 1, xfb_offset = 12) out float v_age;
layout(location = 2, xfb_offset = 16) flat out uint v_mark;

void main() {
    if (v_position_older[0].w < 1.0) {
        float older = 0.5 * v_position_older[0].w;
        for (int i = 0; i < 2; i++) {
            v_position = v_position_older[0].xyz + wind * float(i);
            v_age = older;
            v_mark = uint(gl_PrimitiveIDIn);
            EmitVertex();
        }
    }
}
