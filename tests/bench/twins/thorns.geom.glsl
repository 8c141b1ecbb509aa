#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    int ribs;
    float depth;
    float thorn_length;
};

layout(triangles) in;
layout(triangle_strip, max_vertices = 12) out;

layout(location = 0) in vec4 place_and_rib[];
layout(location = 1) in vec4 direction_and_phase[];
layout(location = 2) in vec3 normal[];

layout(location = 0) out vec4 view_and_tip;
layout(location = 1) out vec4 normal_and_phase;

void emit(int corner, vec3 place, float tip) {
    gl_Position = view_projection * vec4(place, 1.0);
    view_and_tip = vec4(eye - place, tip);
    normal_and_phase = vec4(normal[corner], direction_and_phase[corner].w);
    EmitVertex();
}

void main() {
    for (int i = 0; i < 3; i++) {
        emit(i, place_and_rib[i].xyz, 0.0);
    }
    EndPrimitive();
    if (!(place_and_rib[0].w > 0.9)) return;

    vec3 foot = mix(
        mix(place_and_rib[0].xyz, place_and_rib[1].xyz, 0.5), place_and_rib[2].xyz, 1.0 / 3.0
    );
    for (int i = 0; i < 9; i++) {
        int side = i % 3;
        int corner = (i / 3 + side) % 3;
        float tip = side == 2 ? 1.0 : 0.0;
        vec3 ground = mix(foot, place_and_rib[corner].xyz, 0.3 * (1.0 - tip));
        emit(corner, ground + tip * thorn_length * direction_and_phase[corner].xyz, tip);
        if (side == 2) EndPrimitive();
    }
}
