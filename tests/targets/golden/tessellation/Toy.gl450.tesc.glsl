#version 450 core
// Toy: control shader, by Burnish.

layout(vertices = 3) out;

layout(location = 1) in vec3 v_place[];

layout(location = 1) out vec3 p_place[];

layout(location = 0) patch out float v_edge_level_0;

void main() {
    p_place[gl_InvocationID] = v_place[gl_InvocationID];
    if (gl_InvocationID == 0) {
        float edge_level_0 = length(v_place[1] - v_place[2]);
        v_edge_level_0 = edge_level_0;
        gl_TessLevelOuter[0] = edge_level_0;
        gl_TessLevelOuter[1] = length(v_place[2] - v_place[0]);
        gl_TessLevelOuter[2] = length(v_place[0] - v_place[1]);
        gl_TessLevelInner[0] = edge_level_0;
    }
}
