// Odd: vertex and fragment shaders, by Burnish.

struct Material {
    threshold: f32,
    texture: u32,
    pad_0: f32,
    pad_1: f32,
    turn: array<vec4f, 3>,
}

@group(2) @binding(0) var<uniform> material: Material;

struct VertexInput {
    @builtin(vertex_index) vertex_index: u32,
    @builtin(instance_index) instance_index: u32,
}

struct VertexOutput {
    @location(0) @interpolate(flat) id: u32,
    @builtin(position) clip_position: vec4f,
}

@vertex
fn vs_main(input: VertexInput) -> VertexOutput {
    var output: VertexOutput;
    output.id = input.instance_index + 7u;
    output.clip_position = vec4f(f32(input.vertex_index), -0.5, 1e-7, 1.0);
    return output;
}

struct FragmentInput {
    @location(0) @interpolate(flat) id: u32,
    @builtin(position) frag_coord: vec4f,
    @builtin(front_facing) front_facing: bool,
}

struct FragmentOutput {
    @location(0) color: vec4f,
    @location(1) motion: vec2f,
}

@fragment
fn fs_main(input: FragmentInput) -> FragmentOutput {
    let turn = mat3x3f(material.turn[0].xyz, material.turn[1].xyz, material.turn[2].xyz);
    let turned = turn * input.frag_coord.xyz;
    var result: vec3f;
    if (input.front_facing) {
        var inner: f32;
        if (material.texture == 4294967295u && (input.front_facing || material.texture == 4294967295u)) {
            inner = turned.x;
        } else {
            inner = f32(-2147483647 - 1) * 0.1;
        }
        result = vec3f(inner);
    } else {
        let column = turn[1];
        result = column;
    }
    let final_ = pow(clamp(result, vec3f(0.0), vec3f(material.threshold)), vec3f(2.0));
    var output: FragmentOutput;
    output.color = vec4f((-1.0 * turn) * final_, f32(input.id));
    output.motion = vec2f(0.25);
    if (turned.x < material.threshold) {
        discard;
    }
    return output;
}
