#version 450

layout(std140, set = 0, binding = 1) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float size;
};

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 place_and_age[];

layout(location = 0) out float age;

void main() {
    for (int i = 0; i < 4; i++) {
        vec2 corner = 2.0 * vec2(float(i % 2), float(i / 2)) - 1.0;
        vec3 place = place_and_age[0].xyz + vec3(size * corner, 0.0);
        gl_Position = view_projection * vec4(place, 1.0);
        age = place_and_age[0].w;
        EmitVertex();
    }
    EndPrimitive();
}
