#version 450

layout(std140, set = 2, binding = 0) uniform Material {
    vec3 base;
    vec3 sheen;
    float strand_length;
    float droop;
    float frizz;
    float number;
};

layout(vertices = 2) out;

layout(location = 1) in vec3 place[];
layout(location = 2) in vec3 normal[];

layout(location = 1) out vec3 place_of_point[];
layout(location = 2) out vec3 normal_of_point[];
layout(location = 0) patch out uint edge;

void main() {
    place_of_point[gl_InvocationID] = place[gl_InvocationID];
    normal_of_point[gl_InvocationID] = normal[gl_InvocationID];
    if (gl_InvocationID == 0) {
        edge = uint(gl_PrimitiveID);
        gl_TessLevelOuter[0] = number;
        gl_TessLevelOuter[1] = 3.0;
    }
}
