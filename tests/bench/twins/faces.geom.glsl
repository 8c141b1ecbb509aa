#version 450

layout(std140, set = 0, binding = 0) uniform Frame {
    vec3 centre;
    float nearest;
    float farthest;
};
layout(std140, set = 0, binding = 1) uniform FrameDerived {
    float range;
};

layout(triangles) in;
layout(triangle_strip, max_vertices = 18) out;

layout(location = 0) in vec4 place_and_u[];
layout(location = 1) in vec3 normal[];

layout(location = 0) out vec4 normal_and_u;

vec3 seen_from(int face, vec3 way) {
    switch (face) {
        case 0: return vec3(-way.z, way.y, way.x);
        case 1: return vec3(way.z, way.y, -way.x);
        case 2: return vec3(way.x, -way.z, way.y);
        case 3: return vec3(way.x, way.z, -way.y);
        case 4: return way;
        default: return vec3(-way.x, way.y, -way.z);
    }
}

void main() {
    for (int face = 0; face < 6; face++) {
        for (int i = 0; i < 3; i++) {
            vec3 seen = seen_from(face, place_and_u[i].xyz - centre);
            gl_Position = vec4(seen.xy, farthest * (seen.z - nearest) / range, seen.z);
            gl_Layer = face;
            normal_and_u = vec4(normal[i], place_and_u[i].w);
            EmitVertex();
        }
        EndPrimitive();
    }
}
