//! Draws materials of Burnish with wgpu: `cargo run -- plastic plastic.png`.
//!
//! `build.rs` has Burnish compile the materials and write the binding, the module `shaders`.

use std::collections::HashMap;
use std::error::Error;
use std::fs::File;

use serde_json::Value;
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};
use wgpu::*;

#[rustfmt::skip]
mod shaders {
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
use shaders::{for_wgpu, Block, Bytes};

const SCENE: &str = include_str!("../scene.json");
const COLORS: TextureFormat = TextureFormat::Rgba8UnormSrgb;
const DEPTHS: TextureFormat = TextureFormat::Depth32Float;

type Told<T> = Result<T, Box<dyn Error>>;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let Err(error) = run(&words) {
        eprintln!("{error}");
        std::process::exit(1);
    }
}

fn run(words: &[String]) -> Told<()> {
    let [name, output] = words else {
        return Err("usage: cargo run -- plastic|banner OUTPUT.png".into());
    };
    let scene: Value = serde_json::from_str(SCENE)?;
    let draw = match name.as_str() {
        "plastic" => plastic,
        "banner" => banner,
        _ => return Err(format!("there is no scene `{name}`: there are plastic, banner").into()),
    };
    let host = Host::new(&scene)?;
    draw(&host, &scene["scenes"][name])?;
    host.write(output)
}

// -- what is drawn ------------------------------------------------------------------------------

/// A ball with lights of all kinds and a texture.
fn plastic(host: &Host, scene: &Value) -> Told<()> {
    let (lights, model) = (&scene["lights"], &scene["models"][0]);
    let lamp = |lamp: &Value| shaders::Point {
        place: lanes(&lamp["place"]),
        diffuse_color: lanes(&lamp["diffuse_color"]),
        ..shaders::Point::DEFAULT
    };
    let mut rig = shaders::Rig {
        sun_direction: lanes(&lights["sun"]["direction"]),
        torch_place: lanes(&lights["torch"]["place"]),
        torch_axis: lanes(&lights["torch"]["axis"]),
        ..shaders::Rig::DEFAULT
    };
    rig.set_lamps(&list(&lights["lamps"], lamp))?;
    rig.check()?;
    let material = shaders::PlasticMaterial::DEFAULT;
    let draw = shaders::Draw {
        object_to_world: matrix(&model["object_to_world"]),
    };
    let (of_rig, of_draw) = (shaders::derive_rig(&rig), shaders::derive_draw(&draw));
    let blocks: [&dyn Block; 6] = [&host.view(), &rig, &of_rig, &material, &draw, &of_draw];
    host.draw(&for_wgpu::PLASTIC, &blocks, scene)
}

/// A cloth that bones bend, with a normal map.
fn banner(host: &Host, scene: &Value) -> Told<()> {
    let direction = lanes(&scene["lights"]["sun"]["direction"]);
    let rig = shaders::BannerRig {
        sun_direction: direction,
        ..shaders::BannerRig::DEFAULT
    };
    rig.check()?;
    let material = shaders::BannerMaterial::DEFAULT;
    let draw = shaders::BannerDraw {
        object_to_world: matrix(&scene["models"][0]["object_to_world"]),
        bones: std::array::from_fn(|bone| matrix(&host.scene["bones"][bone])),
    };
    let of_draw = shaders::derive_banner_draw(&draw);
    let blocks: [&dyn Block; 5] = [&host.view(), &rig, &material, &draw, &of_draw];
    host.draw(&for_wgpu::BANNER, &blocks, scene)
}

// -- how it is drawn ----------------------------------------------------------------------------

struct Host<'a> {
    scene: &'a Value,
    device: Device,
    queue: Queue,
    size: Extent3d,
    picture: Texture,
}

impl<'a> Host<'a> {
    fn new(scene: &'a Value) -> Told<Self> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
        let options = RequestAdapterOptions::default();
        let adapter = pollster::block_on(instance.request_adapter(&options))?;
        let (device, queue) =
            pollster::block_on(adapter.request_device(&DeviceDescriptor::default()))?;
        let [width, height] = lanes(&scene["size"]).map(|side| side as u32);
        let size = Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let picture = device.create_texture(&target(size, COLORS, TextureUsages::COPY_SRC));
        Ok(Host {
            scene,
            device,
            queue,
            size,
            picture,
        })
    }

    fn view(&self) -> shaders::View {
        let camera = &self.scene["camera"];
        let view_projection = matrix(&camera["view_projection"]);
        shaders::View {
            view_projection,
            eye: lanes(&camera["eye"]),
            ..shaders::View::DEFAULT
        }
    }

    /// Draws the first model of a scene.
    fn draw(
        &self,
        material: &for_wgpu::Descriptors,
        blocks: &[&dyn Block],
        scene: &Value,
    ) -> Told<()> {
        let (device, mesh) = (
            &self.device,
            &self.scene["meshes"][text(&scene["models"][0]["mesh"])],
        );
        let textures = self.textures(material, scene)?;
        let indices = list(&mesh["indices"], whole);
        let depths = device.create_texture(&target(self.size, DEPTHS, TextureUsages::empty()));
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
        let mut pass = begun(&mut encoder, &self.picture, &depths);
        // -- glue
        let layouts = material.bind_group_layouts(device);
        let buffers = for_wgpu::uniform_buffers(device, blocks);
        let groups = material.bind_groups(device, &layouts, &buffers, &textures)?;
        pass.set_pipeline(&material.render_pipeline(device, &layouts, &[COLORS], Some(DEPTHS)));
        for (number, group) in groups.iter().enumerate() {
            pass.set_bind_group(number as u32, group, &[]);
        }
        for (slot, input) in material.material.vertex_inputs.iter().enumerate() {
            pass.set_vertex_buffer(slot as u32, self.vertices(mesh, input).slice(..));
        }
        pass.set_index_buffer(
            self.buffer(&indices.bytes(), BufferUsages::INDEX).slice(..),
            IndexFormat::Uint32,
        );
        pass.draw_indexed(0..indices.len() as u32, 0, 0..1);
        // -- end of glue
        drop(pass);
        self.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// The buffer of a vertex input: `vertex_normal` is the mesh's `normal`.
    fn vertices(&self, mesh: &Value, input: &shaders::VertexInput) -> Buffer {
        let values = &mesh[input.name.trim_start_matches("vertex_")];
        let bytes = match input.format.starts_with("uint") {
            true => list(values, whole).bytes(),
            false => list(values, number).bytes(),
        };
        self.buffer(&bytes, BufferUsages::VERTEX)
    }

    fn buffer(&self, contents: &[u8], usage: BufferUsages) -> Buffer {
        self.device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents,
            usage,
        })
    }

    /// The views of the scene's pictures, by the names of textures.
    fn textures(
        &self,
        material: &for_wgpu::Descriptors,
        scene: &Value,
    ) -> Told<HashMap<&'static str, TextureView>> {
        let view = |each: &shaders::Texture| {
            let picture = &self.scene["pictures"][text(&scene["textures"][each.name])];
            let format = match each.intent {
                "color" => TextureFormat::Rgba8UnormSrgb,
                _ => TextureFormat::Rgba8Unorm,
            };
            let [width, height] = [&picture["width"], &picture["height"]].map(whole);
            let size = Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            };
            let usage = TextureUsages::TEXTURE_BINDING;
            let descriptor = TextureDescriptor {
                usage,
                ..target(size, format, usage)
            };
            let texels: Vec<u8> = list(&picture["rgba"], |byte| whole(byte) as u8);
            let order = TextureDataOrder::default();
            let texture =
                self.device
                    .create_texture_with_data(&self.queue, &descriptor, order, &texels);
            (
                each.name,
                texture.create_view(&TextureViewDescriptor::default()),
            )
        };
        Ok(material.material.textures.iter().map(view).collect())
    }

    /// Writes the picture to a file.
    fn write(&self, output: &str) -> Told<()> {
        let Extent3d { width, height, .. } = self.size;
        let buffer = self.device.create_buffer(&BufferDescriptor {
            label: None,
            size: u64::from(4 * width * height),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * width),
            rows_per_image: None,
        };
        let mut encoder = self
            .device
            .create_command_encoder(&CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.picture.as_image_copy(),
            TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            self.size,
        );
        self.queue.submit([encoder.finish()]);
        buffer.map_async(MapMode::Read, .., |done| {
            done.expect("the picture can be read")
        });
        self.device.poll(PollType::wait_indefinitely())?;
        let mut file = png::Encoder::new(File::create(output)?, width, height);
        file.set_color(png::ColorType::Rgba);
        file.write_header()?
            .write_image_data(&buffer.get_mapped_range(..)?)?;
        Ok(())
    }
}

fn target(
    size: Extent3d,
    format: TextureFormat,
    usage: TextureUsages,
) -> TextureDescriptor<'static> {
    TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage: usage | TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    }
}

/// A pass that draws to colours and depths, which it clears.
fn begun<'a>(
    encoder: &'a mut CommandEncoder,
    colors: &Texture,
    depths: &Texture,
) -> RenderPass<'a> {
    let [colors, depths] =
        [colors, depths].map(|each| each.create_view(&TextureViewDescriptor::default()));
    encoder.begin_render_pass(&RenderPassDescriptor {
        color_attachments: &[Some(RenderPassColorAttachment {
            view: &colors,
            depth_slice: None,
            resolve_target: None,
            ops: Operations {
                load: LoadOp::Clear(Color::BLACK),
                store: StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
            view: &depths,
            depth_ops: Some(Operations {
                load: LoadOp::Clear(1.0),
                store: StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

// -- what scene.json has ------------------------------------------------------------------------

fn text(value: &Value) -> &str {
    value.as_str().expect("scene.json has a text here")
}

fn number(value: &Value) -> f32 {
    value.as_f64().expect("scene.json has a number here") as f32
}

fn whole(value: &Value) -> u32 {
    number(value) as u32
}

fn list<T>(value: &Value, one: impl Fn(&Value) -> T) -> Vec<T> {
    value
        .as_array()
        .expect("scene.json has a list here")
        .iter()
        .map(one)
        .collect()
}

fn lanes<const N: usize>(value: &Value) -> [f32; N] {
    std::array::from_fn(|lane| number(&value[lane]))
}

/// The columns of a matrix.
fn matrix(value: &Value) -> [[f32; 4]; 4] {
    std::array::from_fn(|column| std::array::from_fn(|lane| number(&value[4 * column + lane])))
}
