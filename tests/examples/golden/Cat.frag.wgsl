// Cat: fragment shader, by Burnish.
// Hardly combed.

struct Material {
    fur_length: f32,
    shells: i32,
    density: f32,
}

@group(2) @binding(0) var<uniform> material: Material;

struct FragmentInput {
    @location(0) normal_height: vec4f,
    @location(1) uv: vec2f,
}

/// Zero stays zero.
fn safe_normalize_(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1.1754944e-38));
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    let inherited_color = mix(
        vec3f(0.14702727, 0.06847817, 0.024157632), vec3f(0.69387174, 0.3515326, 0.13286832),
        0.5 + 0.5 * safe_normalize_(input.normal_height.xyz).y
    );
    let color = inherited_color * (0.2 + 0.8 * input.normal_height.w);
    let middle = length(fract(material.density * vec2f(2.0 * input.uv.x, input.uv.y)) - 0.5);
    let reach = max(1.0 - 2.0 * middle, 0.0);
    let alpha = select(0.0, 1.0, input.normal_height.w < reach + 0.05);
    return vec4f(color, alpha);
}
