// Painted, for Bevy 0.19: by Burnish.
// For files whose meshes have colours.

#import bevy_pbr::{
    decal::clustered,
    mesh_functions,
    pbr_bindings,
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

struct PaintedParameters {
    is_two_sided: u32,
    base_color: vec4<f32>,
    metallic: f32,
    roughness: f32,
    emissive: vec3<f32>,
    occlusion_strength: f32,
    normal_scale: f32,
    is_opaque: u32,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<uniform> parameters: PaintedParameters;
@group(#{MATERIAL_BIND_GROUP}) @binding(101) var base_color_map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(102) var base_color_map_sampler: sampler;
@group(#{MATERIAL_BIND_GROUP}) @binding(103) var metallic_roughness_map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(104) var metallic_roughness_map_sampler: sampler;
@group(#{MATERIAL_BIND_GROUP}) @binding(105) var emissive_map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(106) var emissive_map_sampler: sampler;
@group(#{MATERIAL_BIND_GROUP}) @binding(107) var occlusion_map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(108) var occlusion_map_sampler: sampler;
@group(#{MATERIAL_BIND_GROUP}) @binding(109) var normal_map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(110) var normal_map_sampler: sampler;

/// Zero stays zero.
fn painted_safe_normalize(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1.1754944e-38));
}

/// base_color_map: Multiplies the base colour and its alpha
fn painted_base(
    uv: vec2f, vertex_color: vec4f, base_color: vec4f, base_color_map: texture_2d<f32>,
    base_color_map_sampler: sampler
) -> vec4f {
    let inherited_base = base_color * textureSample(base_color_map, base_color_map_sampler, uv);
    return inherited_base * vertex_color;
}

/// metallic_roughness_map: Roughness in green, how metallic in blue
fn painted_metalness(
    uv: vec2f, metallic: f32, metallic_roughness_map: texture_2d<f32>, metallic_roughness_map_sampler: sampler
) -> f32 {
    return metallic * textureSample(metallic_roughness_map, metallic_roughness_map_sampler, uv).z;
}

/// Of the microfacets; never so smooth that a highlight has no size.
/// metallic_roughness_map: Roughness in green, how metallic in blue
fn painted_width(
    uv: vec2f, roughness: f32, metallic_roughness_map: texture_2d<f32>,
    metallic_roughness_map_sampler: sampler
) -> f32 {
    let width_at_least = max(
        roughness * textureSample(metallic_roughness_map, metallic_roughness_map_sampler, uv).y, 0.045
    );
    return width_at_least * width_at_least;
}

/// Light of its own.
/// emissive: Light of its own
fn painted_glow(
    uv: vec2f, emissive: vec3f, emissive_map: texture_2d<f32>, emissive_map_sampler: sampler
) -> vec3f {
    return emissive * textureSample(emissive_map, emissive_map_sampler, uv).xyz;
}

/// occlusion_map: In red: what arrives from all around
fn painted_occlusion(
    uv: vec2f, occlusion_strength: f32, occlusion_map: texture_2d<f32>, occlusion_map_sampler: sampler
) -> f32 {
    return mix(1.0, textureSample(occlusion_map, occlusion_map_sampler, uv).x, occlusion_strength);
}

/// As the map bends it, towards the side that is seen.
/// normal_scale: The factor by which bumps lean
/// normal_map: x along u, y against v
fn painted_normal(
    uv: vec2f, tangent: vec3f, normal: vec3f, tangent_handedness: f32, is_front: f32, front_facing: bool,
    normal_scale: f32, normal_map: texture_2d<f32>, normal_map_sampler: sampler
) -> vec3f {
    // True on the side that the mesh shows as its front, which is another one where it is mirrored.
    let is_front_ = front_facing == (is_front > 0.0);
    let tangent_ = painted_safe_normalize(tangent);
    let inherited_normal = painted_safe_normalize(normal);
    // Against v, upwards on the picture.
    let bitangent = cross(inherited_normal, tangent_) * tangent_handedness;
    let normal_map_ = textureSample(normal_map, normal_map_sampler, uv);
    let bent_normal = painted_safe_normalize(
        mat3x3f(tangent_, bitangent, inherited_normal)
        * ((2.0 * normal_map_.xyz - 1.0) * vec3f(normal_scale, normal_scale, 1.0))
    );
    return select(-bent_normal, bent_normal, is_front_);
}

/// Coverage
/// is_opaque: If true, its alpha has no effect
/// base_color_map: Multiplies the base colour and its alpha
fn painted_alpha(
    uv: vec2f, vertex_color: vec4f, base_color: vec4f, is_opaque: bool, base_color_map: texture_2d<f32>,
    base_color_map_sampler: sampler
) -> f32 {
    let base_color_map_ = textureSample(base_color_map, base_color_map_sampler, uv);
    let base = base_color * base_color_map_ * vertex_color;
    return select(base.w, 1.0, is_opaque);
}

/// Where `Forward`, and what is derived from it, draw nothing
/// is_two_sided: If false, nothing is seen from behind
fn painted_is_hidden(is_front: f32, front_facing: bool, is_two_sided: bool) -> bool {
    // True on the side that the mesh shows as its front, which is another one where it is mirrored.
    let is_front_ = front_facing == (is_front > 0.0);
    return !(is_front_ || is_two_sided);
}

/// vertex_tangent: Along u; w is the sign of the third axis
fn painted_tangent_handedness(vertex_tangent: vec4f, object_to_world: mat4x4f) -> f32 {
    return select(
        vertex_tangent.w, -vertex_tangent.w,
        determinant(mat3x3f(object_to_world[0].xyz, object_to_world[1].xyz, object_to_world[2].xyz)) < 0.0
    );
}

/// vertex_tangent: Along u; w is the sign of the third axis
fn painted_is_front(vertex_tangent: vec4f, object_to_world: mat4x4f) -> f32 {
    // The sign of the third axis in the world, where the object may be mirrored.
    let tangent_handedness = select(
        vertex_tangent.w, -vertex_tangent.w,
        determinant(mat3x3f(object_to_world[0].xyz, object_to_world[1].xyz, object_to_world[2].xyz)) < 0.0
    );
    return tangent_handedness * vertex_tangent.w;
}

/// What vertices hand to pixels: what Bevy hands over, and values of the material.
struct PaintedVertexOutput {
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
    @location(10) is_front: f32,
    @location(11) tangent_handedness: f32,
}

@vertex
fn vertex(given: Vertex) -> PaintedVertexOutput {
    var vertex = given;
    var out: PaintedVertexOutput;
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
    out.is_front = painted_is_front(given.tangent, world_from_local);
    out.tangent_handedness = painted_tangent_handedness(given.tangent, world_from_local);
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
#endif
    return out;
}

#ifdef DEFERRED_PREPASS
@fragment
fn fragment(
    pixel: VertexOutput,
    @builtin(front_facing) front_facing: bool,
    @location(10) is_front: f32,
    @location(11) tangent_handedness: f32,
) -> FragmentOutput {
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
    var pbr_input = pbr_fragment::pbr_input_from_standard_material(pixel, front_facing);
    if (painted_is_hidden(is_front, front_facing, parameters.is_two_sided != 0u)) { discard; }
    pbr_input.material.base_color = vec4<f32>(
        painted_base(
            pixel.uv, pixel.color, parameters.base_color, base_color_map, base_color_map_sampler
        ).rgb,
        pbr_input.material.base_color.a
    );
    pbr_input.material.metallic = painted_metalness(
        pixel.uv, parameters.metallic, metallic_roughness_map, metallic_roughness_map_sampler
    );
    pbr_input.material.perceptual_roughness = sqrt(
        painted_width(pixel.uv, parameters.roughness, metallic_roughness_map, metallic_roughness_map_sampler)
    );
    pbr_input.material.emissive = vec4<f32>(
        painted_glow(pixel.uv, parameters.emissive, emissive_map, emissive_map_sampler),
        pbr_input.material.emissive.a
    );
    pbr_input.diffuse_occlusion *= vec3(
        painted_occlusion(pixel.uv, parameters.occlusion_strength, occlusion_map, occlusion_map_sampler)
    );
    pbr_input.N = normalize(
        painted_normal(
            pixel.uv, pixel.world_tangent.xyz, pixel.world_normal, tangent_handedness, is_front, front_facing,
            parameters.normal_scale, normal_map, normal_map_sampler
        )
    );
    pbr_input.material.base_color.a = painted_alpha(
        pixel.uv, pixel.color, parameters.base_color, parameters.is_opaque != 0u, base_color_map,
        base_color_map_sampler
    );
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
    @location(10) is_front: f32,
    @location(11) tangent_handedness: f32,
) -> FragmentOutput {
#else
fn fragment(
    pixel: VertexOutput,
    @builtin(front_facing) front_facing: bool,
    @location(10) is_front: f32,
    @location(11) tangent_handedness: f32,
) {
#endif
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
#ifdef MAY_DISCARD
    if (painted_is_hidden(is_front, front_facing, parameters.is_two_sided != 0u)) { discard; }
    let coverage = painted_alpha(
        pixel.uv, pixel.color, parameters.base_color, parameters.is_opaque != 0u, base_color_map,
        base_color_map_sampler
    );
    let flags = pbr_bindings::material.flags;
    let mode = flags & pbr_types::STANDARD_MATERIAL_FLAGS_ALPHA_MODE_RESERVED_BITS;
    let is_mask = mode == pbr_types::STANDARD_MATERIAL_FLAGS_ALPHA_MODE_MASK;
    // What is blended is drawn, and throws shadows, from the same coverage on as in Bevy.
    if coverage < select(0.05, pbr_bindings::material.alpha_cutoff, is_mask) { discard; }
#endif
#ifdef PREPASS_FRAGMENT
    var out: FragmentOutput;
#ifdef NORMAL_PREPASS
    out.normal = vec4<f32>(
        normalize(
                painted_normal(
                    pixel.uv, pixel.world_tangent.xyz, pixel.world_normal, tangent_handedness, is_front,
                    front_facing, parameters.normal_scale, normal_map, normal_map_sampler
                )
            ) * 0.5
            + 0.5,
        1.0
    );
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
    @location(10) is_front: f32,
    @location(11) tangent_handedness: f32,
) -> FragmentOutput {
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
    var pbr_input = pbr_fragment::pbr_input_from_standard_material(pixel, front_facing);
    if (painted_is_hidden(is_front, front_facing, parameters.is_two_sided != 0u)) { discard; }
    pbr_input.material.base_color = vec4<f32>(
        painted_base(
            pixel.uv, pixel.color, parameters.base_color, base_color_map, base_color_map_sampler
        ).rgb,
        pbr_input.material.base_color.a
    );
    pbr_input.material.metallic = painted_metalness(
        pixel.uv, parameters.metallic, metallic_roughness_map, metallic_roughness_map_sampler
    );
    pbr_input.material.perceptual_roughness = sqrt(
        painted_width(pixel.uv, parameters.roughness, metallic_roughness_map, metallic_roughness_map_sampler)
    );
    pbr_input.material.emissive = vec4<f32>(
        painted_glow(pixel.uv, parameters.emissive, emissive_map, emissive_map_sampler),
        pbr_input.material.emissive.a
    );
    pbr_input.diffuse_occlusion *= vec3(
        painted_occlusion(pixel.uv, parameters.occlusion_strength, occlusion_map, occlusion_map_sampler)
    );
    pbr_input.N = normalize(
        painted_normal(
            pixel.uv, pixel.world_tangent.xyz, pixel.world_normal, tangent_handedness, is_front, front_facing,
            parameters.normal_scale, normal_map, normal_map_sampler
        )
    );
    pbr_input.material.base_color.a = painted_alpha(
        pixel.uv, pixel.color, parameters.base_color, parameters.is_opaque != 0u, base_color_map,
        base_color_map_sampler
    );
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
