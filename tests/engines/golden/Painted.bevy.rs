//! Painted, for Bevy 0.19: by Burnish.
//! For files whose meshes have colours.
//!
//! Add `PaintedPlugin` behind `DefaultPlugins`, and give meshes a
//! `MeshMaterial3d(materials.add(Painted::default().material()))`.

#![allow(dead_code)] // A program need not use all of it.

use bevy::asset::{RenderAssetUsages, load_internal_asset, uuid_handle};
use bevy::image::{
    ImageAddressMode, ImageFilterMode, ImageLoaderSettings, ImageSampler, ImageSamplerDescriptor,
};
use bevy::mesh::MeshVertexBufferLayoutRef;
use bevy::pbr::{
    ExtendedMaterial, MaterialExtension, MaterialExtensionKey, MaterialExtensionPipeline,
};
use bevy::prelude::*;
use bevy::render::render_resource::*;
use bevy::shader::{ShaderDefVal, ShaderRef};

/// The shader, which is in a file beside this one.
const SHADER: Handle<Shader> = uuid_handle!("ebb1a2eb-d337-5342-bdcc-a10d182eebfa");
/// The texture until another one is set: white.
const WHITE_2D: Handle<Image> = uuid_handle!("a9de7408-5abb-59af-8138-5c562c7feb29");
/// The texture until another one is set: flat normal.
const FLAT_NORMAL_2D: Handle<Image> = uuid_handle!("0d0d2852-2ff8-556c-8169-5aeb95158a93");

/// Bevy's standard material, whose surface is what `Painted` says.
pub type PaintedMaterial = ExtendedMaterial<StandardMaterial, Painted>;

/// For files whose meshes have colours.
#[derive(Asset, AsBindGroup, Reflect, Debug, Clone)]
#[uniform(100, PaintedParameters)]
pub struct Painted {
    /// If false, nothing is seen from behind
    pub is_two_sided: bool,
    /// In linear light.
    pub base_color: LinearRgba,
    /// From 0 to 1.
    pub metallic: f32,
    /// From 0 to 1.
    pub roughness: f32,
    /// Light of its own. In linear light.
    pub emissive: LinearRgba,
    /// From 0 to 1.
    pub occlusion_strength: f32,
    /// The factor by which bumps lean. From -16 to 16.
    pub normal_scale: f32,
    /// If true, its alpha has no effect
    pub is_opaque: bool,
    /// Multiplies the base colour and its alpha. Until it is set, white.
    #[texture(101)]
    #[sampler(102)]
    pub base_color_map: Handle<Image>,
    /// Roughness in green, how metallic in blue. Until it is set, white.
    #[texture(103)]
    #[sampler(104)]
    pub metallic_roughness_map: Handle<Image>,
    /// Until it is set, white.
    #[texture(105)]
    #[sampler(106)]
    pub emissive_map: Handle<Image>,
    /// In red: what arrives from all around. Until it is set, white.
    #[texture(107)]
    #[sampler(108)]
    pub occlusion_map: Handle<Image>,
    /// x along u, y against v. Until it is set, flat normal.
    #[texture(109)]
    #[sampler(110)]
    pub normal_map: Handle<Image>,
}

impl Default for Painted {
    fn default() -> Self {
        Self {
            is_two_sided: false,
            base_color: LinearRgba::new(1.0, 1.0, 1.0, 1.0),
            metallic: 0.0,
            roughness: 0.45,
            emissive: LinearRgba::new(0.0, 0.0, 0.0, 1.0),
            occlusion_strength: 1.0,
            normal_scale: 1.0,
            is_opaque: true,
            base_color_map: WHITE_2D.clone(),
            metallic_roughness_map: WHITE_2D.clone(),
            emissive_map: WHITE_2D.clone(),
            occlusion_map: WHITE_2D.clone(),
            normal_map: FLAT_NORMAL_2D.clone(),
        }
    }
}

impl Painted {
    /// The material with the settings of Bevy's own that it needs; these may be changed.
    pub fn material(self) -> PaintedMaterial {
        let base = StandardMaterial {
            alpha_mode: if self.is_opaque { AlphaMode::Mask(0.5) } else { AlphaMode::Blend },
            cull_mode: None,
            double_sided: true,
            ..default()
        };
        ExtendedMaterial { base, extension: self }
    }

    /// How an image for `base_color_map` is loaded, by `load_builder().with_settings(…)`.
    pub fn load_base_color_map(settings: &mut ImageLoaderSettings) {
        settings.is_srgb = true;
        settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
            address_mode_u: ImageAddressMode::Repeat,
            address_mode_v: ImageAddressMode::Repeat,
            address_mode_w: ImageAddressMode::Repeat,
            mag_filter: ImageFilterMode::Linear,
            min_filter: ImageFilterMode::Linear,
            mipmap_filter: ImageFilterMode::Linear,
            ..default()
        });
    }

    /// How an image for `metallic_roughness_map` is loaded, by `load_builder().with_settings(…)`.
    pub fn load_metallic_roughness_map(settings: &mut ImageLoaderSettings) {
        settings.is_srgb = false;
        settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
            address_mode_u: ImageAddressMode::Repeat,
            address_mode_v: ImageAddressMode::Repeat,
            address_mode_w: ImageAddressMode::Repeat,
            mag_filter: ImageFilterMode::Linear,
            min_filter: ImageFilterMode::Linear,
            mipmap_filter: ImageFilterMode::Linear,
            ..default()
        });
    }

    /// How an image for `emissive_map` is loaded, by `load_builder().with_settings(…)`.
    pub fn load_emissive_map(settings: &mut ImageLoaderSettings) {
        settings.is_srgb = true;
        settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
            address_mode_u: ImageAddressMode::Repeat,
            address_mode_v: ImageAddressMode::Repeat,
            address_mode_w: ImageAddressMode::Repeat,
            mag_filter: ImageFilterMode::Linear,
            min_filter: ImageFilterMode::Linear,
            mipmap_filter: ImageFilterMode::Linear,
            ..default()
        });
    }

    /// How an image for `occlusion_map` is loaded, by `load_builder().with_settings(…)`.
    pub fn load_occlusion_map(settings: &mut ImageLoaderSettings) {
        settings.is_srgb = false;
        settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
            address_mode_u: ImageAddressMode::Repeat,
            address_mode_v: ImageAddressMode::Repeat,
            address_mode_w: ImageAddressMode::Repeat,
            mag_filter: ImageFilterMode::Linear,
            min_filter: ImageFilterMode::Linear,
            mipmap_filter: ImageFilterMode::Linear,
            ..default()
        });
    }

    /// How an image for `normal_map` is loaded, by `load_builder().with_settings(…)`.
    pub fn load_normal_map(settings: &mut ImageLoaderSettings) {
        settings.is_srgb = false;
        settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
            address_mode_u: ImageAddressMode::Repeat,
            address_mode_v: ImageAddressMode::Repeat,
            address_mode_w: ImageAddressMode::Repeat,
            mag_filter: ImageFilterMode::Linear,
            min_filter: ImageFilterMode::Linear,
            mipmap_filter: ImageFilterMode::Linear,
            ..default()
        });
    }
}

/// The parameters as the shader has them.
#[derive(ShaderType, Debug, Clone)]
pub struct PaintedParameters {
    is_two_sided: u32,
    base_color: Vec4,
    metallic: f32,
    roughness: f32,
    emissive: Vec3,
    occlusion_strength: f32,
    normal_scale: f32,
    is_opaque: u32,
}

impl From<&Painted> for PaintedParameters {
    fn from(material: &Painted) -> Self {
        Self {
            is_two_sided: material.is_two_sided.into(),
            base_color: material.base_color.to_vec4(),
            metallic: material.metallic,
            roughness: material.roughness,
            emissive: material.emissive.to_vec3(),
            occlusion_strength: material.occlusion_strength,
            normal_scale: material.normal_scale,
            is_opaque: material.is_opaque.into(),
        }
    }
}

impl MaterialExtension for Painted {
    fn vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn prepass_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn prepass_fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn specialize(
        _pipeline: &MaterialExtensionPipeline,
        descriptor: &mut RenderPipelineDescriptor,
        layout: &MeshVertexBufferLayoutRef,
        _key: MaterialExtensionKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        // A mesh has to have all that is read of it.
        layout.0.get_layout(&[
            Mesh::ATTRIBUTE_NORMAL.at_shader_location(0),
            Mesh::ATTRIBUTE_TANGENT.at_shader_location(1),
            Mesh::ATTRIBUTE_UV_0.at_shader_location(2),
            Mesh::ATTRIBUTE_COLOR.at_shader_location(3),
        ])?;
        // Where only depths are drawn, Bevy leaves these out.
        let defs = &mut descriptor.vertex.shader_defs;
        let has_normals = ShaderDefVal::from("NORMAL_PREPASS_OR_DEFERRED_PREPASS");
        if defs.contains(&"PREPASS_PIPELINE".into()) && !defs.contains(&has_normals) {
            let added = [has_normals, "VERTEX_NORMALS".into(), "VERTEX_TANGENTS".into()];
            defs.extend(added.clone());
            if let Some(fragment) = &mut descriptor.fragment {
                fragment.shader_defs.extend(added);
            }
            let inputs = layout.0.get_layout(&[
                Mesh::ATTRIBUTE_NORMAL.at_shader_location(3),
                Mesh::ATTRIBUTE_TANGENT.at_shader_location(4),
            ])?;
            descriptor.vertex.buffers[0].attributes.extend(inputs.attributes);
        }
        Ok(())
    }
}

/// Adds the material to an app, behind `DefaultPlugins`.
pub struct PaintedPlugin;

impl Plugin for PaintedPlugin {
    fn build(&self, app: &mut App) {
        load_internal_asset!(app, SHADER, "Painted.wgsl", Shader::from_wgsl);
        let mut images = app.world_mut().resource_mut::<Assets<Image>>();
        let image = texel(
            TextureViewDimension::D2,
            TextureFormat::Rgba16Float,
            [0x3c00, 0x3c00, 0x3c00, 0x3c00],
        );
        images.insert(WHITE_2D.id(), image).expect("its identity is its own");
        let image = texel(
            TextureViewDimension::D2,
            TextureFormat::Rgba16Float,
            [0x3804, 0x3804, 0x3c00, 0x3c00],
        );
        images.insert(FLAT_NORMAL_2D.id(), image).expect("its identity is its own");
        app.add_plugins(MaterialPlugin::<PaintedMaterial>::default());
    }
}

/// A texture of one texel, whose lanes have 16 bits.
fn texel(dimension: TextureViewDimension, format: TextureFormat, lanes: [u16; 4]) -> Image {
    let (of, layers) = match dimension {
        TextureViewDimension::D3 => (TextureDimension::D3, 1),
        TextureViewDimension::Cube | TextureViewDimension::CubeArray => (TextureDimension::D2, 6),
        _ => (TextureDimension::D2, 1),
    };
    let size = Extent3d { width: 1, height: 1, depth_or_array_layers: layers };
    let bytes = lanes.map(u16::to_le_bytes).concat();
    let mut image = Image::new_fill(size, of, &bytes, format, RenderAssetUsages::RENDER_WORLD);
    image.texture_view_descriptor =
        Some(TextureViewDescriptor { dimension: Some(dimension), ..default() });
    image
}
