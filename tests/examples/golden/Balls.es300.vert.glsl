#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Balls: vertex shader, by Burnish.
// Balls of wool.

layout(std140) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140) uniform Material {
    float size;
    uint step_;  /// One vertex of so many has a sprite
};

layout(std140) uniform Draw {
    mat4 object_to_world;
};

layout(location = 0) in vec3 corner0_vertex_position;
layout(location = 1) in vec2 corner0_vertex_uv;

out vec3 v_square_uv;

void main() {
    int emitted_vertex_to_int = int(min(uint(gl_VertexID), 5u));
    int emitted_vertex_quotient = emitted_vertex_to_int / 3;
    int emitted_vertex_remainder = emitted_vertex_to_int % 3;
    int emitted_vertex = emitted_vertex_quotient + (
        emitted_vertex_quotient % 2 != 0 && emitted_vertex_remainder != 0
        ? 3 - emitted_vertex_remainder
        : emitted_vertex_remainder
    );
    vec2 square = 2.0 * vec2(float(emitted_vertex % 2), float(emitted_vertex / 2)) - 1.0;
    vec4 placed = vec4(0.0, 0.0, -1.0, 1.0);
    if (uint(gl_InstanceID) % step_ == 0u) {
        vec3 position = (object_to_world * vec4(corner0_vertex_position, 1.0)).xyz;
        vec3 above_difference = eye - position;
        vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), above_difference));
        vec2 position_product = size * square;
        vec3 above = normalize(cross(above_difference, right));
        vec3 position_ = position + (right * position_product.x + above * position_product.y);
        placed = view_projection * vec4(position_, 1.0);
    }
    v_square_uv = vec3(square, corner0_vertex_uv.y);
    gl_Position = placed;
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
