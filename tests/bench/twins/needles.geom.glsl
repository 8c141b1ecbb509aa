#version 450

layout(std140, set = 0, binding = 0) uniform Frame {
    float needle_length;
};
layout(std140, set = 0, binding = 1) uniform View {
    mat4 view_projection;
    vec3 eye;
};

layout(triangles) in;
layout(line_strip, max_vertices = 2) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];

layout(location = 0) out vec3 direction;

void main() {
    vec3 middle = place[0] + (place[1] - place[0]) / 3.0 + (place[2] - place[0]) / 3.0;
    vec3 upright = normalize(normal[0] + normal[1] + normal[2]);
    for (int i = 0; i < 2; i++) {
        gl_Position = view_projection * vec4(middle + needle_length * float(i) * upright, 1.0);
        direction = upright;
        EmitVertex();
    }
    EndPrimitive();
}
