#version 100
precision highp float;
precision highp int;
// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

uniform mat4 world_to_clip;
uniform vec3 eye;  /// Where the camera stands, in world space

uniform mat4 object_to_world;

attribute vec3 position;
attribute vec3 normal;
attribute vec2 uv;

varying vec3 v_position;
varying vec4 v_normal;
varying vec2 v_uv;

void main() {
    // In world space, homogeneous
    vec4 position_ = object_to_world * vec4(position, 1.0);
    v_position = position_.xyz;
    v_normal = vec4((object_to_world * vec4(normal, 0.0)).xyz, 0.5);
    v_uv = uv;
    gl_Position = world_to_clip * position_;
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
