//! Plastic, for Bevy 0.19: by Burnish.
//! Plastic after the classic three-term model.
//!
//! Add `PlasticPlugin` behind `DefaultPlugins`, and give meshes a
//! `MeshMaterial3d(materials.add(Plastic::default().material()))`.

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
use bevy::shader::ShaderRef;

/// The shader, which is in a file beside this one.
const SHADER: Handle<Shader> = uuid_handle!("ca829410-d772-5555-ae90-7f7f94f32f65");
/// The texture until another one is set: white.
const WHITE_2D: Handle<Image> = uuid_handle!("a9de7408-5abb-59af-8138-5c562c7feb29");

/// Bevy's standard material, whose surface is what `Plastic` says.
pub type PlasticMaterial = ExtendedMaterial<StandardMaterial, Plastic>;

/// Plastic after the classic three-term model.
#[derive(Asset, AsBindGroup, Reflect, Debug, Clone)]
#[uniform(100, PlasticParameters)]
pub struct Plastic {
    /// Base colour. In linear light.
    pub base: LinearRgba,
    /// Multiplies the base colour. Until it is set, white.
    #[texture(101)]
    #[sampler(102)]
    pub albedo: Handle<Image>,
}

impl Default for Plastic {
    fn default() -> Self {
        Self {
            base: LinearRgba::new(0.462077, 0.130136477, 0.0122864884, 1.0),
            albedo: WHITE_2D.clone(),
        }
    }
}

impl Plastic {
    /// The material with the settings of Bevy's own that it needs; these may be changed.
    pub fn material(self) -> PlasticMaterial {
        let base = StandardMaterial::default();
        ExtendedMaterial { base, extension: self }
    }

    /// How an image for `albedo` is loaded, by `load_builder().with_settings(…)`.
    pub fn load_albedo(settings: &mut ImageLoaderSettings) {
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
}

/// The parameters as the shader has them.
#[derive(ShaderType, Debug, Clone)]
pub struct PlasticParameters {
    base: Vec3,
}

impl From<&Plastic> for PlasticParameters {
    fn from(material: &Plastic) -> Self {
        Self {
            base: material.base.to_vec3(),
        }
    }
}

impl MaterialExtension for Plastic {
    fn fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn specialize(
        _pipeline: &MaterialExtensionPipeline,
        _descriptor: &mut RenderPipelineDescriptor,
        layout: &MeshVertexBufferLayoutRef,
        _key: MaterialExtensionKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        // A mesh has to have all that is read of it.
        layout.0.get_layout(&[
            Mesh::ATTRIBUTE_UV_0.at_shader_location(0),
        ])?;
        Ok(())
    }
}

/// Adds the material to an app, behind `DefaultPlugins`.
pub struct PlasticPlugin;

impl Plugin for PlasticPlugin {
    fn build(&self, app: &mut App) {
        load_internal_asset!(app, SHADER, "Plastic.wgsl", Shader::from_wgsl);
        let mut images = app.world_mut().resource_mut::<Assets<Image>>();
        let image = texel(
            TextureViewDimension::D2,
            TextureFormat::Rgba16Float,
            [0x3c00, 0x3c00, 0x3c00, 0x3c00],
        );
        images.insert(WHITE_2D.id(), image).expect("its identity is its own");
        app.add_plugins(MaterialPlugin::<PlasticMaterial>::default());
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
