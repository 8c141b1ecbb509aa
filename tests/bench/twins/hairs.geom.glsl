#version 450

layout(std140, set = 0, binding = 0) uniform Frame {
    float hair_length;
    int strands;
};
layout(std140, set = 0, binding = 1) uniform FrameDerived {
    float strands_on_edge;
};
layout(std140, set = 0, binding = 2) uniform View {
    mat4 view_projection;
    vec3 eye;
};

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 15) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 direction[];
layout(location = 2) in vec3 normal[];

layout(location = 0) out vec4 normal_and_height;
layout(location = 1) out float strand;

float facing(vec3 a, vec3 b, vec3 c) {
    return dot(cross(b - a, c - a), eye - a);
}

void main() {
    for (int i = 0; i < 6; i += 2) {
        gl_Position = view_projection * vec4(place[i], 1.0);
        normal_and_height = vec4(normal[i], -1.0);
        strand = 0.0;
        EmitVertex();
    }
    EndPrimitive();

    if (!(facing(place[0], place[2], place[4]) > 0.0)) return;
    for (int i = 0; i < 6; i += 2) {
        int next = (i + 2) % 6;
        if (!(facing(place[i], place[i + 1], place[next]) <= 0.0)) continue;
        for (int k = 0; k < 4; k++) {
            int side = k % 2;
            int corner = side == 0 ? i : next;
            float height = float(k / 2);
            vec3 tip = place[corner] + hair_length * height * direction[corner];
            gl_Position = view_projection * vec4(tip, 1.0);
            normal_and_height = vec4(normal[corner], height);
            strand = strands_on_edge * float(side);
            EmitVertex();
        }
        EndPrimitive();
    }
}
