#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float ink_width;
};

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 15) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 direction[];
layout(location = 2) in vec3 normal[];

layout(location = 0) out vec4 normal_and_ink;

bool is_seen(vec3 a, vec3 b, vec3 c) {
    return dot(cross(b - a, c - a), eye - a) > 0.0;
}

void emit(int corner, float away, float ink) {
    gl_Position = view_projection * vec4(place[corner] + away * direction[corner], 1.0);
    normal_and_ink = vec4(normal[corner], ink);
    EmitVertex();
}

void main() {
    for (int i = 0; i < 6; i += 2) {
        gl_Position = view_projection * vec4(place[i], 1.0);
        normal_and_ink = vec4(normal[i], 0.0);
        EmitVertex();
    }
    EndPrimitive();

    if (!is_seen(place[0], place[2], place[4])) return;
    for (int i = 0; i < 6; i += 2) {
        int next = (i + 2) % 6;
        if (is_seen(place[i], place[i + 1], place[next])) continue;
        for (int k = 0; k < 4; k++) {
            emit(k % 2 == 0 ? i : next, ink_width * float(k / 2), 1.0);
        }
        EndPrimitive();
    }
}
