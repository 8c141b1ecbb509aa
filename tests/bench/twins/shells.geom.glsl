#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float fur_length;
    int shells;
    float density;
};
layout(std140, set = 2, binding = 1) uniform MaterialDerived {
    float last_shell;
};

layout(triangles) in;
layout(triangle_strip, max_vertices = 48) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 direction[];
layout(location = 2) in vec3 normal[];
layout(location = 3) in vec2 uv[];

layout(location = 0) out vec4 normal_and_height;
layout(location = 1) out vec2 uv_of_shell;

void main() {
    for (int shell = 0; shell < shells; shell++) {
        float height = float(shell) / last_shell;
        float away = fur_length * height;
        for (int i = 0; i < 3; i++) {
            gl_Position = view_projection * vec4(place[i] + away * direction[i], 1.0);
            normal_and_height = vec4(normal[i], height);
            uv_of_shell = uv[i];
            EmitVertex();
        }
        EndPrimitive();
    }
}
