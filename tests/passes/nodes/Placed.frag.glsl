#version 450
// Placed: fragment shader, by Burnish.
// Placed by constants: the numbers are computed, and only the read is left.

layout(set = 2, binding = 5) uniform texture2D detail;
layout(set = 2, binding = 6) uniform sampler detail_sampler;

layout(location = 0) in vec2 v_uv;

layout(location = 0) out vec4 out_color;

void main() {
    vec3 y = max(texture(sampler2D(detail, detail_sampler), v_uv).xyz, vec3(0.0));
    out_color = vec4(y, 1.0);
}
