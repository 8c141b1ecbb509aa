#version 450 core
// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.

layout(std140, binding = 1) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140, binding = 8) uniform Draw {
    mat4 object_to_world;
};

layout(std140, binding = 9) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec2 vertex_uv;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 2) out vec2 v_uv;

void main() {
    vec3 position = (object_to_world * vec4(vertex_position, 1.0)).xyz;
    v_position = position;
    v_normal = (normal_matrix * vertex_normal).xyz;
    v_uv = vertex_uv;
    gl_Position = view_projection * vec4(position, 1.0);
}
