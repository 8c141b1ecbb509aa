// Graded: fragment shader, by Burnish.
// Colours that an affine transform corrects, seen along a plane.

struct Draw {
    object_to_world: mat4x4f,
    grade: mat4x4f,
    tilt: mat2x4f,
}

@group(3) @binding(0) var<uniform> draw: Draw;

struct FragmentInput {
    @location(0) normal: vec3f,
    @location(1) uv: vec2f,
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    // Zero stays zero.
    let normal = input.normal * inverseSqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    let graded = (draw.grade * vec4f(normal, 1.0)).xyz;
    let own = mat3x2f(input.uv, input.uv.yx, vec2f(1.0, input.uv.x));
    let slope = transpose(mat2x3f(draw.tilt[0].xyz, draw.tilt[1].xyz)) * graded
        + (own * mat4x3f(draw.grade[0].xyz, draw.grade[1].xyz, draw.grade[2].xyz, draw.grade[3].xyz))[3];
    let color = graded + (draw.tilt * slope).xyz;
    return vec4f(color, 1.0);
}
