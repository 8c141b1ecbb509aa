// Odd: vertex shader, by Burnish.

struct VertexInput {
    @builtin(vertex_index) vertex_index: u32,
    @builtin(instance_index) instance_index: u32,
}

struct VertexOutput {
    @location(0) @interpolate(flat) id: u32,
    @builtin(position) clip_position: vec4f,
}

@vertex
fn main(input: VertexInput) -> VertexOutput {
    var output: VertexOutput;
    output.id = input.instance_index + 7u;
    output.clip_position = vec4f(f32(input.vertex_index), -0.5, 1e-7, 1.0);
    return output;
}
