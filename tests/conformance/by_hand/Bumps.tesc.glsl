#version 450

layout(std140, set = 2, binding = 0) uniform Values {
    float level;
    float height;
    int bump_count;
};
layout(std430, set = 2, binding = 5) readonly buffer Heights {
    float bumps[];
};

layout(vertices = 4) out;

layout(location = 0) in vec2 uv_of_corner[];

layout(location = 0) out vec2 uv_of_point[];
layout(location = 1) patch out float bump_of_patch;

void main() {
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    uv_of_point[gl_InvocationID] = uv_of_corner[gl_InvocationID];
    if (gl_InvocationID != 0) return;
    bump_of_patch = height * bumps[min(gl_PrimitiveID % 3, bump_count - 1)];
    gl_TessLevelOuter = float[](level, level, level, level);
    gl_TessLevelInner = float[](2.0 * level, 2.0 * level);
}
