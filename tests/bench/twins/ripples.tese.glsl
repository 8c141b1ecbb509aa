#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float detail;
    float ripples;
    float height;
};
layout(std140, set = 2, binding = 1) uniform MaterialDerived {
    float slope_of_ripples;
    float ripples_in_radians;
};
layout(std140, set = 3, binding = 0) uniform Draw {
    mat4 object_to_world;
};
layout(std140, set = 3, binding = 1) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(triangles, equal_spacing, cw) in;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 uv[];

layout(location = 0) out vec4 normal_and_phase;

vec3 mixed(vec3 a, vec3 b, vec3 c) {
    return gl_TessCoord.x * a + gl_TessCoord.y * b + gl_TessCoord.z * c;
}

void main() {
    vec3 world = (object_to_world * vec4(mixed(place[0], place[1], place[2]), 1.0)).xyz;
    float v = dot(gl_TessCoord, vec3(uv[0].y, uv[1].y, uv[2].y));
    float phase = ripples_in_radians * v;

    vec3 upright = (normal_matrix * mixed(normal[0], normal[1], normal[2])).xyz;
    vec3 n = upright * inversesqrt(max(dot(upright, upright), 1.1754944e-38));
    vec3 south = n * n.y - vec3(0.0, 1.0, 0.0);
    vec3 rippled = normalize(n - slope_of_ripples * cos(phase) * south);

    normal_and_phase = vec4(upright, phase);
    gl_Position = view_projection * vec4(world + height * sin(phase) * rippled, 1.0);
}
