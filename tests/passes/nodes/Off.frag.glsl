#version 450
// Off: fragment shader, by Burnish.
// Everything is switched off: what is left is the texture coordinate.

layout(location = 0) in vec2 v_uv;

layout(location = 0) out vec4 out_color;

void main() {
    out_color = vec4(vec3(v_uv.x, v_uv.y, 0.0), 1.0);
}
