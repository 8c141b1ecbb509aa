#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// PerVertex: vertex shader, by Burnish.
// Per vertex, after Gouraud: the colour is computed at the vertices and interpolated.

layout(std140) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140) uniform Rig {
    vec3 ambient_light;  /// Light from everywhere
    vec3 sun_diffuse_color;
    vec3 sun_specular_color;
    vec3 sun_direction;  /// Where the light travels
};

layout(std140) uniform Material {
    vec3 kd;
    float p;
};

layout(std140) uniform Draw {
    mat4 object_to_world;
};

layout(std140) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;

out vec3 v_color;

void main() {
    vec3 position = (object_to_world * vec4(vertex_position, 1.0)).xyz;
    vec3 normal_upright = (normal_matrix * vertex_normal).xyz;
    // Zero stays zero.
    vec3 normal = normal_upright * inversesqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    float normal_dot_sun_to_light = dot(normal, -sun_direction);
    float color_mirrored = 0.0;
    if (normal_dot_sun_to_light > 0.0) {
        vec3 to_eye = normalize(eye - position);
        color_mirrored = pow(clamp(dot(reflect(sun_direction, normal), to_eye), 0.0, 1.0), p);
    }
    v_color = kd * ambient_light + (
        kd * clamp(normal_dot_sun_to_light, 0.0, 1.0) * sun_diffuse_color
        + 0.6 * color_mirrored * sun_specular_color
    );
    gl_Position = view_projection * vec4(position, 1.0);
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
