// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct View {
    world_to_clip: mat4x4f,
    eye: vec3f,  /// Where the camera stands, in world space
}

struct Draw {
    object_to_world: mat4x4f,
}

@group(0) @binding(1) var<uniform> view: View;
@group(3) @binding(0) var<uniform> draw: Draw;

struct VertexInput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
}

struct VertexOutput {
    @location(0) position: vec3f,
    @location(1) normal: vec4f,
    @location(2) uv: vec2f,
    @builtin(position) clip_position: vec4f,
}

@vertex
fn main(input: VertexInput) -> VertexOutput {
    // In world space, homogeneous
    let position = draw.object_to_world * vec4f(input.position, 1.0);
    var output: VertexOutput;
    output.position = position.xyz;
    output.normal = vec4f((draw.object_to_world * vec4f(input.normal, 0.0)).xyz, 0.5);
    output.uv = input.uv;
    output.clip_position = view.world_to_clip * position;
    return output;
}
