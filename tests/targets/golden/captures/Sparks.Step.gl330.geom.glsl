#version 330 core
// Sparks: geometry shader, by Burnish.
// Every spark that is young enough becomes two.

layout(std140) uniform Material {
    vec3 wind;
};

layout(points) in;
layout(points, max_vertices = 2) out;

in vec4 v_position_older[];

out vec3 v_position;  /// In world space
out float v_age;
flat out uint v_mark;

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
