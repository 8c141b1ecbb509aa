#version 450
// Terrain: fragment shader, by Burnish.
// Ground of several kinds, one in each layer.

layout(std140, set = 1, binding = 0) uniform Rig {
    vec3 ambient_light;  /// Light from everywhere
    vec3 sun_diffuse_color;
    vec3 sun_specular_color;
    vec3 sun_direction;  /// Where the light travels
};

layout(std140, set = 2, binding = 0) uniform Material {
    int flat_;  /// Layer of flat places
    int steep;  /// Layer of steep ones; at most the last
};

layout(set = 2, binding = 5) uniform texture2DArray ground;
layout(set = 2, binding = 6) uniform sampler ground_sampler;

layout(location = 0) in vec3 v_normal;
layout(location = 1) in vec2 v_uv;

layout(location = 0) out vec4 out_color;

void main() {
    // Zero stays zero.
    vec3 normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38));
    float flatness = smoothstep(0.5, 0.8, normal.y);
    vec3 tint = mix(
        texture(sampler2DArray(ground, ground_sampler), vec3(v_uv, steep)).xyz,
        texture(sampler2DArray(ground, ground_sampler), vec3(v_uv, flat_)).xyz, flatness
    );
    vec3 color = tint * ambient_light
        + tint * clamp(dot(normal, -sun_direction), 0.0, 1.0) * sun_diffuse_color;
    out_color = vec4(color, 1.0);
}
