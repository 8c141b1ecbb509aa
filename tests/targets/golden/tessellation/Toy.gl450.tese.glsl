#version 450 core
// Toy: evaluation shader, by Burnish.

layout(triangles, equal_spacing, ccw) in;

layout(location = 1) in vec3 p_place[];

layout(location = 0) out vec4 v_varying;

layout(location = 0) patch in float v_edge_level_0;

void main() {
    vec4 joined = vec4(
        p_place[0] * gl_TessCoord.x + p_place[1] * gl_TessCoord.y + p_place[2] * gl_TessCoord.z,
        v_edge_level_0
    );
    v_varying = joined;
    gl_Position = joined;
}
