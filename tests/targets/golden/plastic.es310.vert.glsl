#version 310 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

layout(std140, binding = 1) uniform View {
    mat4 world_to_clip;
    vec3 eye;  /// Where the camera stands, in world space
};

layout(std140, binding = 8) uniform Draw {
    mat4 object_to_world;
};

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec4 v_normal;
layout(location = 2) out vec2 v_uv;

void main() {
    // In world space, homogeneous
    vec4 position_ = object_to_world * vec4(position, 1.0);
    v_position = position_.xyz;
    v_normal = vec4((object_to_world * vec4(normal, 0.0)).xyz, 0.5);
    v_uv = uv;
    gl_Position = world_to_clip * position_;
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
