#version 450 core
// Blanket: evaluation shader, by Burnish.
// A blanket that is finer where it is wider.

layout(std140, binding = 1) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140, binding = 3) uniform Material {
    float detail;
    float bump;  /// How far the middles of the triangles rise.
};

layout(std140, binding = 8) uniform Draw {
    mat4 object_to_world;
};

layout(std140, binding = 9) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(quads, fractional_odd_spacing, ccw) in;

layout(location = 0) in vec3 p_object_position[];
layout(location = 1) in vec3 p_object_normal[];
layout(location = 2) in vec2 p_uv_2[];

layout(location = 0) out vec2 v_uv;

void main() {
    // Before `object_to_world`
    vec3 object_position = mix(
        mix(p_object_position[0], p_object_position[1], gl_TessCoord.x),
        mix(p_object_position[3], p_object_position[2], gl_TessCoord.x), gl_TessCoord.y
    );
    vec3 inherited_position = (object_to_world * vec4(object_position, 1.0)).xyz;
    vec3 object_normal = mix(
        mix(p_object_normal[0], p_object_normal[1], gl_TessCoord.x),
        mix(p_object_normal[3], p_object_normal[2], gl_TessCoord.x), gl_TessCoord.y
    );
    vec3 normal_upright = (normal_matrix * object_normal).xyz;
    // Zero stays zero.
    vec3 normal = normal_upright * inversesqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    vec3 position = inherited_position + bump * gl_TessCoord.x * (1.0 - gl_TessCoord.x) * normal;
    v_uv = mix(
        mix(p_uv_2[0], p_uv_2[1], gl_TessCoord.x), mix(p_uv_2[3], p_uv_2[2], gl_TessCoord.x), gl_TessCoord.y
    );
    gl_Position = view_projection * vec4(position, 1.0);
}
