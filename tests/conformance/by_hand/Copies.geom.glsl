#version 450

layout(std140, set = 0, binding = 1) uniform Camera {
    mat4 world_to_clip;
};
layout(std140, set = 2, binding = 0) uniform Values {
    int copies;
    vec2 shift;
    int tint_count;
};
layout(std140, set = 3, binding = 0) uniform Object {
    mat4 object_to_world;
};
layout(std430, set = 2, binding = 5) readonly buffer Tints {
    vec4 tints[];
};

layout(triangles) in;
layout(triangle_strip, max_vertices = 12) out;

layout(location = 0) in vec2 uv_of_corner[];

layout(location = 0) out vec3 tint;

void copy(int number) {
    vec4 way = number * vec4(shift, -0.25, 0.0);
    vec3 own = tints[min(number, tint_count - 1)].rgb;
    for (int corner = 0; corner < 3; corner++) {
        gl_Position = world_to_clip * (object_to_world * gl_in[corner].gl_Position + way);
        tint = vec3(own.r, own.gb + uv_of_corner[corner]);
        EmitVertex();
    }
    EndPrimitive();
}

void main() {
    for (int number = 0; number < copies; number++) {
        if ((gl_PrimitiveIDIn + number) % 3 == 0) continue;
        copy(number);
    }
}
