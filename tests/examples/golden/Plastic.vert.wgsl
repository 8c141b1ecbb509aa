// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.

struct View {
    view_projection: mat4x4f,  /// World to clip space
    eye: vec3f,  /// Where the viewer stands
}

struct Draw {
    object_to_world: mat4x4f,
}

struct DrawDerived {
    normal_matrix: mat3x4f,
}

@group(0) @binding(1) var<uniform> view: View;
@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(1) var<uniform> draw_derived: DrawDerived;

struct VertexInput {
    @location(0) vertex_position: vec3f,
    @location(1) vertex_normal: vec3f,
    @location(2) vertex_uv: vec2f,
}

struct VertexOutput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @builtin(position) clip_position: vec4f,
}

@vertex
fn main(input: VertexInput) -> VertexOutput {
    let position = (draw.object_to_world * vec4f(input.vertex_position, 1.0)).xyz;
    var output: VertexOutput;
    output.position = position;
    output.normal = (draw_derived.normal_matrix * input.vertex_normal).xyz;
    output.uv = input.vertex_uv;
    output.clip_position = view.view_projection * vec4f(position, 1.0);
    return output;
}
