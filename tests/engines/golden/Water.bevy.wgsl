// Water, for Bevy 0.19: by Burnish.
// Waves over a plane that lies flat in the world.

#import bevy_pbr::{
    decal::clustered,
    mesh_functions,
    pbr_fragment,
    pbr_functions,
    pbr_types,
    skinning,
    view_transformations,
}
#ifdef PREPASS_PIPELINE
#import bevy_pbr::{
    prepass_io::{Vertex, VertexOutput, FragmentOutput},
    pbr_deferred_functions,
    pbr_prepass_functions,
}
#else
#import bevy_pbr::forward_io::{Vertex, VertexOutput, FragmentOutput}
#endif

struct WaterParameters {
    time: f32,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<uniform> parameters: WaterParameters;

fn water_normal(normal_2: vec3f) -> vec3f {
    return normal_2 * inverseSqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
}

fn water_position(vertex_position: vec3f, object_to_world: mat4x4f, time: f32) -> vec3f {
    let rest_product = object_to_world * vec4f(vertex_position, 1.0);
    const waves_height: array<f32, 3> = array<f32, 3>(0.06, 0.03, 0.015);
    const waves_sharpness: array<f32, 3> = array<f32, 3>(0.7, 0.6, 0.5);
    const waves_length: array<f32, 3> = array<f32, 3>(1.6, 0.9, 0.5);
    const waves_heading: array<vec2f, 3> = array<vec2f, 3>(
        vec2f(1.0, 0.0), vec2f(0.6, 0.8), vec2f(-0.8, 0.6)
    );
    let rest = rest_product.xz;
    var shift: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        let shift_number = 6.2831855 / waves_length[i];
        let shift_element = waves_heading[i];
        let shift_phase = shift_number * dot(shift_element, rest) - sqrt(9.81 * shift_number) * time;
        shift += waves_height[i]
            * vec3f(waves_sharpness[i] * cos(shift_phase) * shift_element, sin(shift_phase)).xzy;
    }
    return rest_product.xyz + shift;
}

fn water_normal_2(vertex_position: vec3f, object_to_world: mat4x4f, time: f32) -> vec3f {
    const waves_length: array<f32, 3> = array<f32, 3>(1.6, 0.9, 0.5);
    const waves_height: array<f32, 3> = array<f32, 3>(0.06, 0.03, 0.015);
    const waves_heading: array<vec2f, 3> = array<vec2f, 3>(
        vec2f(1.0, 0.0), vec2f(0.6, 0.8), vec2f(-0.8, 0.6)
    );
    let rest = (object_to_world * vec4f(vertex_position, 1.0)).xz;
    const waves_sharpness: array<f32, 3> = array<f32, 3>(0.7, 0.6, 0.5);
    var tilt: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        let tilt_number = 6.2831855 / waves_length[i];
        let tilt_element = waves_heading[i];
        let tilt_phase = tilt_number * dot(tilt_element, rest) - sqrt(9.81 * tilt_number) * time;
        tilt += tilt_number * waves_height[i]
            * vec3f(cos(tilt_phase) * tilt_element, waves_sharpness[i] * sin(tilt_phase)).xzy;
    }
    return vec3f(0.0, 1.0, 0.0) - tilt;
}

/// What vertices hand to pixels: what Bevy hands over, and values of the material.
struct WaterVertexOutput {
    @builtin(position) position: vec4<f32>,
#ifdef PREPASS_PIPELINE
#ifdef VERTEX_UVS_A
    @location(0) uv: vec2<f32>,
#endif
#ifdef VERTEX_UVS_B
    @location(1) uv_b: vec2<f32>,
#endif
#ifdef VERTEX_COLORS
    @location(8) color: vec4<f32>,
#endif
#ifdef NORMAL_PREPASS_OR_DEFERRED_PREPASS
    @location(2) world_normal: vec3<f32>,
#ifdef VERTEX_TANGENTS
    @location(3) world_tangent: vec4<f32>,
#endif
#endif
    @location(4) world_position: vec4<f32>,
#ifdef MOTION_VECTOR_PREPASS
    @location(5) previous_world_position: vec4<f32>,
#endif
#ifdef UNCLIPPED_DEPTH_ORTHO_EMULATION
    @location(6) unclipped_depth: f32,
#endif
    @location(7) instance_index: u32,
#ifdef VISIBILITY_RANGE_DITHER
    @location(9) @interpolate(flat) visibility_range_dither: i32,
#endif
#else
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
#ifdef VERTEX_UVS_A
    @location(2) uv: vec2<f32>,
#endif
#ifdef VERTEX_UVS_B
    @location(3) uv_b: vec2<f32>,
#endif
#ifdef VERTEX_COLORS
    @location(5) color: vec4<f32>,
#endif
#ifdef VERTEX_TANGENTS
    @location(4) world_tangent: vec4<f32>,
#endif
    @location(6) @interpolate(flat) instance_index: u32,
#ifdef VISIBILITY_RANGE_DITHER
    @location(7) @interpolate(flat) visibility_range_dither: i32,
#endif
#endif
    @location(10) normal_2: vec3<f32>,
}

@vertex
fn vertex(given: Vertex) -> WaterVertexOutput {
    var vertex = given;
    var out: WaterVertexOutput;
    let object_to_world = mesh_functions::get_world_from_local(vertex.instance_index);
#ifdef SKINNED
    let world_from_local = skinning::skin_model(
        vertex.joint_indices, vertex.joint_weights, vertex.instance_index
    );
#else
    let world_from_local = object_to_world;
#endif
    var world_position = world_from_local * vec4<f32>(vertex.position, 1.0);
#ifdef VERTEX_NORMALS
#ifdef SKINNED
    var world_normal = skinning::skin_normals(world_from_local, vertex.normal);
#else
    var world_normal = mesh_functions::mesh_normal_local_to_world(
        vertex.normal, vertex.instance_index
    );
#endif
#endif
    out.normal_2 = water_normal_2(given.position, world_from_local, parameters.time);
    let unmoved = world_position;
    world_position = vec4<f32>(water_position(given.position, world_from_local, parameters.time), 1.0);
    out.world_position = world_position;
    out.position = view_transformations::position_world_to_clip(world_position.xyz);
    out.instance_index = vertex.instance_index;
#ifdef VERTEX_NORMALS
    out.world_normal = world_normal;
#endif
#ifdef VERTEX_TANGENTS
    out.world_tangent = mesh_functions::mesh_tangent_local_to_world(
        world_from_local, vertex.tangent, vertex.instance_index
    );
#endif
#ifdef VERTEX_UVS_A
    out.uv = vertex.uv;
#endif
#ifdef VERTEX_UVS_B
    out.uv_b = vertex.uv_b;
#endif
#ifdef VERTEX_COLORS
    out.color = vertex.color;
#endif
#ifdef VISIBILITY_RANGE_DITHER
    out.visibility_range_dither = mesh_functions::get_visibility_range_dither_level(
        vertex.instance_index, object_to_world[3]
    );
#endif
#ifdef UNCLIPPED_DEPTH_ORTHO_EMULATION
    out.unclipped_depth = out.position.z;
    out.position.z = min(out.position.z, 1.0);
#endif
#ifdef MOTION_VECTOR_PREPASS
    // Where the vertex was in the frame before, if the material moved it as it does now.
#ifdef HAS_PREVIOUS_SKIN
    let previous_from_local = skinning::skin_prev_model(
        vertex.joint_indices, vertex.joint_weights, vertex.instance_index
    );
#else
    let previous_from_local = mesh_functions::get_previous_world_from_local(vertex.instance_index);
#endif
    out.previous_world_position = previous_from_local * vec4<f32>(vertex.position, 1.0);
    out.previous_world_position += world_position - unmoved;
#endif
    return out;
}

#ifdef DEFERRED_PREPASS
@fragment
fn fragment(
    pixel: VertexOutput,
    @builtin(front_facing) front_facing: bool,
    @location(10) normal_2: vec3<f32>,
) -> FragmentOutput {
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
    var pbr_input = pbr_fragment::pbr_input_from_standard_material(pixel, front_facing);
    pbr_input.N = normalize(water_normal(normal_2));
    pbr_input.material.base_color = pbr_functions::alpha_discard(
        pbr_input.material, pbr_input.material.base_color
    );
    clustered::apply_decals(&pbr_input);
    return pbr_deferred_functions::deferred_output(pixel, pbr_input);
}
#else ifdef PREPASS_PIPELINE
@fragment
#ifdef PREPASS_FRAGMENT
fn fragment(
    pixel: VertexOutput,
    @builtin(front_facing) front_facing: bool,
    @location(10) normal_2: vec3<f32>,
) -> FragmentOutput {
#else
fn fragment(
    pixel: VertexOutput,
    @builtin(front_facing) front_facing: bool,
    @location(10) normal_2: vec3<f32>,
) {
#endif
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
    pbr_prepass_functions::prepass_alpha_discard(pixel);
#ifdef PREPASS_FRAGMENT
    var out: FragmentOutput;
#ifdef NORMAL_PREPASS
    out.normal = vec4<f32>(normalize(water_normal(normal_2)) * 0.5 + 0.5, 1.0);
#endif
#ifdef MOTION_VECTOR_PREPASS
    out.motion_vector = pbr_prepass_functions::calculate_motion_vector(
        pixel.world_position, pixel.previous_world_position
    );
#endif
#ifdef UNCLIPPED_DEPTH_ORTHO_EMULATION
    out.frag_depth = pixel.unclipped_depth;
#endif
    return out;
#endif
}
#else
@fragment
fn fragment(
    pixel: VertexOutput,
    @builtin(front_facing) front_facing: bool,
    @location(10) normal_2: vec3<f32>,
) -> FragmentOutput {
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
    var pbr_input = pbr_fragment::pbr_input_from_standard_material(pixel, front_facing);
    pbr_input.N = normalize(water_normal(normal_2));
    pbr_input.material.base_color = pbr_functions::alpha_discard(
        pbr_input.material, pbr_input.material.base_color
    );
    clustered::apply_decals(&pbr_input);
    var out: FragmentOutput;
    out.color = pbr_input.material.base_color;
    if (pbr_input.material.flags & pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT) == 0u {
        out.color = pbr_functions::apply_pbr_lighting(pbr_input);
    }
    out.color = pbr_functions::main_pass_post_lighting_processing(pbr_input, out.color);
    return out;
}
#endif
