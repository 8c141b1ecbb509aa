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
    float rig_pad_0;
    vec3 sun_diffuse_color;
    float rig_pad_1;
    vec3 sun_specular_color;
    float rig_pad_2;
    vec3 sun_direction;  /// Where the light travels
};

layout(std140) uniform RigDerived {
    vec3 color_product;
};

layout(std140) uniform Material {
    vec3 kd;
    float p;
};

layout(std140) uniform Draw {
    mat4 object_to_world;
};

layout(std140) uniform DrawDerived {
    vec4 normal_matrix[3];
};

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;

out vec3 v_color;

void main() {
    vec3 position = (object_to_world * vec4(vertex_position, 1.0)).xyz;
    vec3 normal_product = mat3(normal_matrix[0].xyz, normal_matrix[1].xyz, normal_matrix[2].xyz) * vertex_normal;
    vec3 normal = normal_product * inversesqrt(max(dot(normal_product, normal_product), 1.1754944e-38));
    float normal_dot_sun_to_light = dot(normal, -sun_direction);
    vec3 phong = vec3(0.0);
    if (normal_dot_sun_to_light > 0.0) {
        vec3 to_eye_difference = eye - position;
        vec3 to_eye = to_eye_difference * inversesqrt(max(dot(to_eye_difference, to_eye_difference), 1.1754944e-38));
        phong = color_product * pow(clamp(dot(reflect(sun_direction, normal), to_eye), 0.0, 1.0), p);
    }
    v_color = kd * ambient_light + (kd * sun_diffuse_color * clamp(normal_dot_sun_to_light, 0.0, 1.0) + phong);
    gl_Position = view_projection * vec4(position, 1.0);
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
