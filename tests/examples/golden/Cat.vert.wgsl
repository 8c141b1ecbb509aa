// Cat: vertex shader, by Burnish.
// Hardly combed.

struct View {
    view_projection: mat4x4f,  /// World to clip space
    eye: vec3f,  /// Where the viewer stands
}

struct Material {
    fur_length: f32,
    shells: i32,
    density: f32,
}

struct Draw {
    object_to_world: mat4x4f,
}

struct DrawDerived {
    normal_matrix: mat3x4f,
}

@group(0) @binding(1) var<uniform> view: View;
@group(2) @binding(0) var<uniform> material: Material;
@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(1) var<uniform> draw_derived: DrawDerived;

struct VertexInput {
    @location(0) corner0_vertex_position: vec3f,
    @location(1) corner1_vertex_position: vec3f,
    @location(2) corner2_vertex_position: vec3f,
    @location(3) corner0_vertex_normal: vec3f,
    @location(4) corner1_vertex_normal: vec3f,
    @location(5) corner2_vertex_normal: vec3f,
    @location(6) corner0_vertex_uv: vec2f,
    @location(7) corner1_vertex_uv: vec2f,
    @location(8) corner2_vertex_uv: vec2f,
    @builtin(vertex_index) vertex_index: u32,
}

struct VertexOutput {
    @location(0) normal_height: vec4f,
    @location(1) uv: vec2f,
    @builtin(position) clip_position: vec4f,
}

/// Zero stays zero.
fn safe_normalize(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1.1754944e-38));
}

@vertex
fn main(input: VertexInput) -> VertexOutput {
    let emitted_vertex_to_int = i32(min(input.vertex_index, 47u));
    let emitted_strip = emitted_vertex_to_int / 3;
    var object_position_elements: array<vec3f, 3> = array<vec3f, 3>(
        input.corner0_vertex_position, input.corner1_vertex_position, input.corner2_vertex_position
    );
    let emitted_vertex = emitted_vertex_to_int % 3;
    let position = (draw.object_to_world * vec4f(object_position_elements[emitted_vertex], 1.0)).xyz;
    let height = f32(emitted_strip) / f32(material.shells - 1);
    var object_normal_elements: array<vec3f, 3> = array<vec3f, 3>(
        input.corner0_vertex_normal, input.corner1_vertex_normal, input.corner2_vertex_normal
    );
    // Normals stay upright under any scale by the inverse transpose. Their length changes.
    let normal_upright = (draw_derived.normal_matrix * object_normal_elements[emitted_vertex]).xyz;
    let position_ = position + material.fur_length * height * safe_normalize(normal_upright);
    // The position of the vertex in clip space.
    let clip_position_ = view.view_projection * vec4f(position_, 1.0);
    var uv_elements: array<vec2f, 3> = array<vec2f, 3>(
        input.corner0_vertex_uv, input.corner1_vertex_uv, input.corner2_vertex_uv
    );
    var output: VertexOutput;
    output.normal_height = vec4f(normal_upright, height);
    output.uv = uv_elements[emitted_vertex];
    output.clip_position = select(
        vec4f(0.0, 0.0, -1.0, 1.0), clip_position_, emitted_strip < material.shells
    );
    return output;
}
