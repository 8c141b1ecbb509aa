#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};

layout(vertices = 3) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec3 world[];
layout(location = 3) in vec2 uv[];

layout(location = 0) out vec3 place_of_point[];
layout(location = 1) out vec3 normal_of_point[];
layout(location = 3) out vec2 uv_of_point[];

float level(vec3 a, vec3 b) {
    return clamp(10.0 / max(distance(eye, mix(a, b, 0.5)), 0.1), 1.0, 5.0);
}

void main() {
    place_of_point[gl_InvocationID] = place[gl_InvocationID];
    normal_of_point[gl_InvocationID] = normal[gl_InvocationID];
    uv_of_point[gl_InvocationID] = uv[gl_InvocationID];
    if (gl_InvocationID == 0) {
        vec3 levels = vec3(
            level(world[1], world[2]), level(world[2], world[0]), level(world[0], world[1])
        );
        gl_TessLevelOuter[0] = levels.x;
        gl_TessLevelOuter[1] = levels.y;
        gl_TessLevelOuter[2] = levels.z;
        gl_TessLevelInner[0] = max(max(levels.x, levels.y), levels.z);
    }
}
