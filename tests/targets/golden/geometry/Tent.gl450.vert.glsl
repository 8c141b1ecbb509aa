#version 450 core
// Tent: vertex shader, by Burnish.
// A roof over each triangle, walls around it, and a flag on every third one.

layout(std140, binding = 8) uniform Draw {
    mat4 object_to_world;
};

layout(std140, binding = 9) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec2 vertex_uv;
layout(location = 3) in vec3 shift;

layout(location = 0) out vec3 v_shift;
layout(location = 1) out vec3 v_position;
layout(location = 2) out vec3 v_normal;
layout(location = 3) out vec2 v_uv_2;

void main() {
    vec3 normal_upright = (normal_matrix * vertex_normal).xyz;
    v_shift = shift;
    v_position = (object_to_world * vec4(vertex_position, 1.0)).xyz;
    v_normal = normal_upright * inversesqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    v_uv_2 = vertex_uv;
}
