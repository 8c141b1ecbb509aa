// Sparks: compute shader, by Burnish.
// Every spark that is young enough becomes two.

struct MeshPrimitive {
    corner0_vertex_position: vec3f,
    corner0_age: f32,
}

struct Material {
    wind: vec3f,
}

struct Draw {
    object_to_world: mat4x4f,
    mesh_count: i32,  /// The number of elements of `mesh`
}

@group(2) @binding(0) var<uniform> material: Material;
@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(2) var<storage, read> mesh: array<MeshPrimitive>;
@group(3) @binding(3) var<storage, read_write> captured: array<u32>;

struct ComputeInput {
    @builtin(global_invocation_id) index: vec3u,
}

@compute @workgroup_size(64)
fn main(input: ComputeInput) {
    let index = i32(input.index.x);
    if (index >= draw.mesh_count * 2) { return; }
    let primitive = index / 2;
    let position = (draw.object_to_world * vec4f(mesh[primitive].corner0_vertex_position, 1.0)).xyz;
    let emitted_vertex = i32(u32(index % 2));
    let position_ = position + material.wind * f32(emitted_vertex);
    let older = mesh[primitive].corner0_age + 0.1;
    captured[index * 6] = bitcast<u32>(position_.x);
    captured[index * 6 + 1] = bitcast<u32>(position_.y);
    captured[index * 6 + 2] = bitcast<u32>(position_.z);
    captured[index * 6 + 3] = bitcast<u32>(0.5 * older);
    captured[index * 6 + 4] = u32(primitive);
    captured[index * 6 + 5] = select(0u, 1u, older < 1.0);
}
