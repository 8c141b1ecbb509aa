// PerVertex: fragment shader, by Burnish.
// Per vertex, after Gouraud: the colour is computed at the vertices and interpolated.

struct FragmentInput {
    @location(0) color: vec3f,
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    return vec4f(input.color, 1.0);
}
