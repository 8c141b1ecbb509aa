#version 450

layout(vertices = 9) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec2 uv[];

layout(location = 0) out vec3 place_of_point[];
layout(location = 1) out vec2 uv_of_point[];

void main() {
    place_of_point[gl_InvocationID] = place[gl_InvocationID];
    uv_of_point[gl_InvocationID] = uv[gl_InvocationID];
    if (gl_InvocationID == 0) {
        gl_TessLevelOuter[0] = 2.0;
        gl_TessLevelOuter[1] = 2.0;
        gl_TessLevelOuter[2] = 2.0;
        gl_TessLevelOuter[3] = 2.0;
        gl_TessLevelInner[0] = 2.0;
        gl_TessLevelInner[1] = 2.0;
    }
}
