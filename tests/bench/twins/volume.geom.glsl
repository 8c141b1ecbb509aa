#version 450

layout(std140, set = 0, binding = 0) uniform Frame {
    vec3 sun;
};
layout(std140, set = 0, binding = 1) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float reach;
};
layout(std140, set = 2, binding = 1) uniform MaterialDerived {
    vec3 shadow;
};

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 18) out;

layout(location = 0) in vec3 place[];

layout(location = 0) out float depth;

bool is_lit(vec3 a, vec3 b, vec3 c) {
    return dot(cross(b - a, c - a), sun) > 0.0;
}

void main() {
    if (!is_lit(place[0], place[2], place[4])) return;
    for (int i = 0; i < 3; i++) {
        gl_Position = view_projection * vec4(place[2 * i], 1.0);
        depth = 0.0;
        EmitVertex();
    }
    EndPrimitive();
    for (int i = 0; i < 6; i += 2) {
        int next = (i + 2) % 6;
        if (is_lit(place[i], place[i + 1], place[next])) continue;
        for (int k = 0; k < 4; k++) {
            float far = float(k / 2);
            vec3 way = reach * far * sun;
            gl_Position = view_projection * vec4(place[k % 2 == 0 ? i : next] - way, 1.0);
            depth = far;
            EmitVertex();
        }
        EndPrimitive();
    }
    for (int i = 0; i < 3; i++) {
        gl_Position = view_projection * vec4(place[4 - 2 * i] - shadow, 1.0);
        depth = 1.0;
        EmitVertex();
    }
    EndPrimitive();
}
