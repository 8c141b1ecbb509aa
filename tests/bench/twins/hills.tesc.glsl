#version 450

layout(std140, set = 2, binding = 0) uniform Material {
    float level;
};

layout(vertices = 4) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 uv[];

layout(location = 0) out vec3 place_of_point[];
layout(location = 1) out vec3 normal_of_point[];
layout(location = 2) out vec2 uv_of_point[];

void main() {
    place_of_point[gl_InvocationID] = place[gl_InvocationID];
    normal_of_point[gl_InvocationID] = normal[gl_InvocationID];
    uv_of_point[gl_InvocationID] = uv[gl_InvocationID];
    if (gl_InvocationID == 0) {
        gl_TessLevelOuter[0] = level;
        gl_TessLevelOuter[1] = level;
        gl_TessLevelOuter[2] = level;
        gl_TessLevelOuter[3] = level;
        gl_TessLevelInner[0] = level;
        gl_TessLevelInner[1] = level;
    }
}
