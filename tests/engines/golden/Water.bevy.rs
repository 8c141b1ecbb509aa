//! Water, for Bevy 0.19: by Burnish.
//! Waves over a plane that lies flat in the world.
//!
//! Add `WaterPlugin` behind `DefaultPlugins`, and give meshes a
//! `MeshMaterial3d(materials.add(Water::default().material()))`.

#![allow(dead_code)] // A program need not use all of it.

use bevy::asset::{load_internal_asset, uuid_handle};
use bevy::pbr::{ExtendedMaterial, MaterialExtension};
use bevy::prelude::*;
use bevy::render::render_resource::*;
use bevy::shader::ShaderRef;

/// The shader, which is in a file beside this one.
const SHADER: Handle<Shader> = uuid_handle!("e4860bd4-558e-507a-b1ed-65431d74c723");

/// Bevy's standard material, whose surface is what `Water` says.
pub type WaterMaterial = ExtendedMaterial<StandardMaterial, Water>;

/// Waves over a plane that lies flat in the world.
#[derive(Asset, AsBindGroup, Reflect, Debug, Clone)]
#[uniform(100, WaterParameters)]
pub struct Water {
    pub time: f32,
}

impl Default for Water {
    fn default() -> Self {
        Self {
            time: 0.0,
        }
    }
}

impl Water {
    /// The material with the settings of Bevy's own that it needs; these may be changed.
    pub fn material(self) -> WaterMaterial {
        let base = StandardMaterial::default();
        ExtendedMaterial { base, extension: self }
    }
}

/// The parameters as the shader has them.
#[derive(ShaderType, Debug, Clone)]
pub struct WaterParameters {
    time: f32,
}

impl From<&Water> for WaterParameters {
    fn from(material: &Water) -> Self {
        Self {
            time: material.time,
        }
    }
}

impl MaterialExtension for Water {
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
}

/// Adds the material to an app, behind `DefaultPlugins`.
pub struct WaterPlugin;

impl Plugin for WaterPlugin {
    fn build(&self, app: &mut App) {
        load_internal_asset!(app, SHADER, "Water.wgsl", Shader::from_wgsl);
        app.add_plugins(MaterialPlugin::<WaterMaterial>::default());
    }
}
