#version 450 core
// Shared: vertex shader, by Burnish.
// Fins on some triangles, and some more on all.

layout(std140, binding = 8) uniform Draw {
    mat4 object_to_world;
};

layout(std140, binding = 9) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;

layout(location = 0) out vec3 v_normal;
layout(location = 1) out vec3 v_position;

void main() {
    vec3 normal_upright = (normal_matrix * vertex_normal).xyz;
    v_normal = normal_upright * inversesqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    v_position = (object_to_world * vec4(vertex_position, 1.0)).xyz;
}
