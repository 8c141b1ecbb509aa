#version 450 core
// Tent: geometry shader, by Burnish.
// A roof over each triangle, walls around it, and a flag on every third one.

layout(std140, binding = 1) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140, binding = 3) uniform Material {
    int walls;
    float wind;
};

layout(triangles) in;
layout(triangle_strip, max_vertices = 18) out;

layout(location = 0) in vec3 v_shift[];
layout(location = 1) in vec3 v_position[];
layout(location = 2) in vec3 v_normal[];
layout(location = 3) in vec2 v_uv_2[];

layout(location = 0) out vec2 v_uv;
layout(location = 1) flat out int v_part;

void main() {
    for (int i = 0; i < 3; i++) {
        vec3 position = v_position[i] + v_normal[i] + v_shift[0];
        gl_Position = view_projection * vec4(position, 1.0);
        v_uv = v_uv_2[i];
        v_part = 0;
        EmitVertex();
    }
    EndPrimitive();
    for (int wall = 0; wall < min(walls, 3); wall++) {
        for (int i_ = 0; i_ < 4; i_++) {
            int uv_remainder = (wall + i_ % 2) % 3;
            vec3 position = v_position[uv_remainder] + float(i_ / 2) * v_normal[uv_remainder];
            gl_Position = view_projection * vec4(position, 1.0);
            v_uv = v_uv_2[uv_remainder];
            v_part = 1;
            EmitVertex();
        }
        EndPrimitive();
    }
    if (uint(gl_PrimitiveIDIn) % 3u == 0u) {
        for (int i_ = 0; i_ < 3; i_++) {
            vec3 position = v_position[0] + wind * vec3(float(i_ % 2), float(i_), 0.0);
            gl_Position = view_projection * vec4(position, 1.0);
            v_uv = v_uv_2[i_];
            v_part = 2;
            EmitVertex();
        }
        EndPrimitive();
    }
}
