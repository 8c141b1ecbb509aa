#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Balls: fragment shader, by Burnish.
// Balls of wool.

in vec3 v_square_uv;

layout(location = 0) out vec4 out_color;

void main() {
    float rest = 1.0 - dot(v_square_uv.xy, v_square_uv.xy);
    float depth = sqrt(max(rest, 0.0));
    vec3 color = mix(
        vec3(0.462077, 0.13013647, 0.012286488), vec3(0.029556835, 0.116970666, 0.5271151), v_square_uv.z
    ) * (0.2 + 0.8 * depth);
    out_color = vec4(color, 1.0);
}
