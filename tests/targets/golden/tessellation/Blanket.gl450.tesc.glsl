#version 450 core
// Blanket: control shader, by Burnish.
// A blanket that is finer where it is wider.

layout(std140, binding = 3) uniform Material {
    float detail;
    float bump;  /// How far the middles of the triangles rise.
};

layout(vertices = 4) out;

layout(location = 0) in vec3 v_object_position[];
layout(location = 1) in vec3 v_object_normal[];
layout(location = 2) in vec2 v_uv_2[];

layout(location = 0) out vec3 p_object_position[];
layout(location = 1) out vec3 p_object_normal[];
layout(location = 2) out vec2 p_uv_2[];

void main() {
    p_object_position[gl_InvocationID] = v_object_position[gl_InvocationID];
    p_object_normal[gl_InvocationID] = v_object_normal[gl_InvocationID];
    p_uv_2[gl_InvocationID] = v_uv_2[gl_InvocationID];
    if (gl_InvocationID == 0) {
        float edge_level_0 = max(
            1.0 + detail * abs(v_uv_2[0].x - v_uv_2[3].x), 1.0 + detail * abs(v_uv_2[3].x - v_uv_2[0].x)
        );
        float edge_level_1 = max(
            1.0 + detail * abs(v_uv_2[0].x - v_uv_2[1].x), 1.0 + detail * abs(v_uv_2[1].x - v_uv_2[0].x)
        );
        float edge_level_2 = max(
            1.0 + detail * abs(v_uv_2[1].x - v_uv_2[2].x), 1.0 + detail * abs(v_uv_2[2].x - v_uv_2[1].x)
        );
        float edge_level_3 = max(
            1.0 + detail * abs(v_uv_2[3].x - v_uv_2[2].x), 1.0 + detail * abs(v_uv_2[2].x - v_uv_2[3].x)
        );
        gl_TessLevelOuter[0] = edge_level_0;
        gl_TessLevelOuter[1] = edge_level_1;
        gl_TessLevelOuter[2] = edge_level_2;
        gl_TessLevelOuter[3] = edge_level_3;
        gl_TessLevelInner[0] = max(edge_level_1, edge_level_3);
        gl_TessLevelInner[1] = max(edge_level_0, edge_level_2);
    }
}
