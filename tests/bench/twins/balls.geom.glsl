#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float size;
    uint sprites_step;
};

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec2 uv[];

layout(location = 0) out vec3 square_and_v;

void main() {
    if (uint(gl_PrimitiveIDIn) % sprites_step != 0u) return;
    vec3 ahead = eye - place[0];
    vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), ahead));
    vec3 above = normalize(cross(ahead, right));
    for (int i = 0; i < 4; i++) {
        vec2 square = 2.0 * vec2(float(i % 2), float(i / 2)) - 1.0;
        vec2 across = size * square;
        gl_Position = view_projection * vec4(place[0] + right * across.x + above * across.y, 1.0);
        square_and_v = vec3(square, uv[0].y);
        EmitVertex();
    }
    EndPrimitive();
}
