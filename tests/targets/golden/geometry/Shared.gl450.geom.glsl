#version 450 core
// Shared: geometry shader, by Burnish.
// Fins on some triangles, and some more on all.

layout(std140, binding = 1) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140, binding = 3) uniform Material {
    int fins;
};

layout(triangles) in;
layout(triangle_strip, max_vertices = 21) out;

layout(location = 0) in vec3 v_normal[];
layout(location = 1) in vec3 v_position[];

void main() {
    if (dot(v_normal[0], v_normal[1]) > 0.0) {
        vec3 position_cross = cross(v_normal[0], v_normal[1]);
        for (int i = 0; i < 3; i++) {
            gl_Position = view_projection * vec4(v_position[i], 1.0);
            EmitVertex();
        }
        EndPrimitive();
        for (int fin = 0; fin < min(fins, 4); fin++) {
            for (int i_ = 0; i_ < 3; i_++) {
                vec3 position = v_position[i_] + float(i_ + fin) * position_cross;
                gl_Position = view_projection * vec4(position, 1.0);
                EmitVertex();
            }
            EndPrimitive();
        }
        for (int fin_ = 0; fin_ < 2; fin_++) {
            for (int i_ = 0; i_ < 3; i_++) {
                vec3 position = v_position[i_] - float(i_ + fin_) * position_cross;
                gl_Position = view_projection * vec4(position, 1.0);
                EmitVertex();
            }
            EndPrimitive();
        }
    }
}
