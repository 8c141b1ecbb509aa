#version 310 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Odd: fragment shader, by Burnish.

layout(std140, binding = 3) uniform Material {
    float threshold;
    uint texture_;
    float pad_0;
    float pad_1;
    vec4 turn[3];
};

uniform float viewport_height;

layout(location = 0) flat in uint v_id;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec2 out_motion;

void main() {
    mat3 turn_ = mat3(turn[0].xyz, turn[1].xyz, turn[2].xyz);
    vec3 turned = turn_ * vec4(gl_FragCoord.x, viewport_height - gl_FragCoord.y, gl_FragCoord.zw).xyz;
    vec3 result;
    if (gl_FrontFacing) {
        float inner;
        if (texture_ == 4294967295u && (gl_FrontFacing || texture_ == 4294967295u)) {
            inner = turned.x;
        } else {
            inner = float(-2147483647 - 1) * 0.1;
        }
        result = vec3(inner);
    } else {
        vec3 column = turn_[1];
        result = column;
    }
    vec3 final = pow(clamp(result, 0.0, threshold), vec3(2.0));
    out_color = vec4(-turn_ * final, float(v_id));
    out_motion = vec2(0.25);
    if (turned.x < threshold) {
        discard;
    }
}
