//! Draws materials of Burnish with wgpu: `cargo run -- plastic plastic.png`.
//!
//! `build.rs` has Burnish compile the materials and write the binding, the module `shaders`.

use std::collections::HashMap;
use std::error::Error;
use std::fs::File;

use serde_json::Value;
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};
use wgpu::*;

mod shaders {
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
use shaders::{for_wgpu, Blocks, Bytes};

mod shadows;

const SCENE: &str = include_str!("../scene.json");
const COLORS: TextureFormat = TextureFormat::Rgba8UnormSrgb;
const DEPTHS: TextureFormat = TextureFormat::Depth32Float;

type Told<T> = Result<T, Box<dyn Error>>;
type Textures = HashMap<&'static str, TextureView>;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let Err(error) = run(&words) {
        eprintln!("{error}");
        std::process::exit(1);
    }
}

fn run(words: &[String]) -> Told<()> {
    let [name, output] = words else {
        return Err("usage: cargo run -- plastic|banner|shadows OUTPUT.png".into());
    };
    let draw = match name.as_str() {
        "plastic" => plastic,
        "banner" => banner,
        "shadows" => shadows::draw,
        _ => {
            return Err(
                format!("there is no scene `{name}`: there are plastic, banner, shadows").into(),
            )
        }
    };
    let scene: Value = serde_json::from_str(SCENE)?;
    let host = Host::new(&scene)?;
    let picture = draw(&host, &scene["scenes"][name])?;
    host.write(&picture, output)
}

// -- what is drawn ------------------------------------------------------------------------------

/// A ball with lights of all kinds and a texture.
fn plastic(host: &Host, scene: &Value) -> Told<Texture> {
    let lights = &scene["lights"];
    let lamp = |lamp: &Value| shaders::Point {
        place: lanes(&lamp["place"]),
        diffuse_color: lanes(&lamp["diffuse_color"]),
        ..shaders::Point::DEFAULT
    };
    let mut blocks = shaders::PlasticBlocks::DEFAULT;
    let rig = &mut blocks.rig;
    rig.sun_direction = lanes(&lights["sun"]["direction"]);
    rig.torch_place = lanes(&lights["torch"]["place"]);
    rig.torch_axis = lanes(&lights["torch"]["axis"]);
    rig.set_lamps(&list(&lights["lamps"], lamp))?;
    rig.check()?;
    host.draw(&shaders::PLASTIC, &mut blocks, scene)
}

/// A cloth that bones bend, with a normal map.
fn banner(host: &Host, scene: &Value) -> Told<Texture> {
    let mut blocks = shaders::BannerBlocks::DEFAULT;
    blocks.rig.sun_direction = lanes(&scene["lights"]["sun"]["direction"]);
    blocks.rig.check()?;
    blocks.draw.bones = std::array::from_fn(|bone| columns(&host.scene["bones"][bone]));
    host.draw(&shaders::BANNER, &mut blocks, scene)
}

// -- how it is drawn ----------------------------------------------------------------------------

struct Host<'a> {
    scene: &'a Value,
    device: Device,
    queue: Queue,
}

impl<'a> Host<'a> {
    fn new(scene: &'a Value) -> Told<Self> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
        let options = RequestAdapterOptions::default();
        let adapter = pollster::block_on(instance.request_adapter(&options))?;
        let asked = adapter.request_device(&DeviceDescriptor::default());
        let (device, queue) = pollster::block_on(asked)?;
        Ok(Host {
            scene,
            device,
            queue,
        })
    }

    /// Draws the only model of a scene.
    fn draw(
        &self,
        material: &shaders::Material,
        blocks: &mut dyn Blocks,
        scene: &Value,
    ) -> Told<Texture> {
        let model = &scene["models"][0];
        let picture = self.target(COLORS, TextureUsages::COPY_SRC);
        let depths = self.target(DEPTHS, TextureUsages::empty());
        let textures = self.textures(material, scene);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = begun(&mut encoder, &picture, &depths);
        self.place(blocks, model);
        self.draw_model(&mut pass, material, blocks, &textures, model, &[COLORS])?;
        drop(pass);
        self.queue.submit([encoder.finish()]);
        Ok(picture)
    }

    /// Sets what the camera and the place of a model give.
    fn place(&self, blocks: &mut dyn Blocks, model: &Value) {
        let camera = &self.scene["camera"];
        blocks.set_role("world_to_clip", &list(&camera["view_projection"], number));
        blocks.set_role("eye", &list(&camera["eye"], number));
        blocks.set_role("object_to_world", &list(&model["object_to_world"], number));
    }

    /// Draws a model in a pass.
    fn draw_model(
        &self,
        pass: &mut RenderPass,
        material: &shaders::Material,
        blocks: &dyn Blocks,
        textures: &Textures,
        model: &Value,
        targets: &[TextureFormat],
    ) -> Told<()> {
        let (device, mesh) = (&self.device, &self.scene["meshes"][text(&model["mesh"])]);
        // -- glue
        let shader = for_wgpu::of(material);
        let layouts = shader.bind_group_layouts(device);
        let buffers = for_wgpu::uniform_buffers(device, blocks);
        let groups = shader.bind_groups(device, &layouts, &buffers, textures)?;
        pass.set_pipeline(&shader.render_pipeline(device, &layouts, targets, Some(DEPTHS)));
        for (number, group) in (0..).zip(&groups) {
            pass.set_bind_group(number, group, &[]);
        }
        for (slot, input) in (0..).zip(material.vertex_inputs) {
            pass.set_vertex_buffer(slot, self.vertices(mesh, input).slice(..));
        }
        // -- end of glue
        let indices = list(&mesh["indices"], whole);
        let buffer = self.buffer(&indices.bytes(), BufferUsages::INDEX);
        pass.set_index_buffer(buffer.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..indices.len() as u32, 0, 0..1);
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
    fn textures(&self, material: &shaders::Material, scene: &Value) -> Textures {
        let view = |each: &shaders::Texture| {
            let picture = &self.scene["pictures"][text(&scene["textures"][each.name])];
            let format = match each.intent {
                "color" => TextureFormat::Rgba8UnormSrgb,
                _ => TextureFormat::Rgba8Unorm,
            };
            let size = [&picture["width"], &picture["height"]].map(whole);
            let descriptor = described(size, format, TextureUsages::TEXTURE_BINDING);
            let texels = list(&picture["rgba"], |byte| whole(byte) as u8);
            let order = TextureDataOrder::default();
            let texture =
                self.device
                    .create_texture_with_data(&self.queue, &descriptor, order, &texels);
            (each.name, texture.create_view(&Default::default()))
        };
        material.textures.iter().map(view).collect()
    }

    /// A texture of the picture's size that a pass draws to.
    fn target(&self, format: TextureFormat, others: TextureUsages) -> Texture {
        let usage = TextureUsages::RENDER_ATTACHMENT | others;
        self.device
            .create_texture(&described(self.size(), format, usage))
    }

    fn size(&self) -> [u32; 2] {
        lanes(&self.scene["size"]).map(|side| side as u32)
    }

    /// Writes a picture to a file. Its width is a multiple of 64, as copies to buffers want it.
    fn write(&self, picture: &Texture, output: &str) -> Told<()> {
        let (width, height) = (picture.width(), picture.height());
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
        let target = TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(picture.as_image_copy(), target, picture.size());
        self.queue.submit([encoder.finish()]);
        buffer.map_async(MapMode::Read, .., |done| {
            done.expect("the picture can be read")
        });
        self.device.poll(PollType::wait_indefinitely())?;
        let mut file = png::Encoder::new(File::create(output)?, width, height);
        file.set_color(png::ColorType::Rgba);
        let mut pixels = buffer.get_mapped_range(..)?.to_vec();
        pixels
            .iter_mut()
            .skip(3)
            .step_by(4)
            .for_each(|alpha| *alpha = 255);
        file.write_header()?.write_image_data(&pixels)?;
        Ok(())
    }
}

fn described(
    [width, height]: [u32; 2],
    format: TextureFormat,
    usage: TextureUsages,
) -> TextureDescriptor<'static> {
    TextureDescriptor {
        label: None,
        size: Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    }
}

/// A pass that draws to colours and depths, which it clears.
fn begun<'a>(
    encoder: &'a mut CommandEncoder,
    colors: &Texture,
    depths: &Texture,
) -> RenderPass<'a> {
    let [colors, depths] = [colors, depths].map(|each| each.create_view(&Default::default()));
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
fn columns(value: &Value) -> [[f32; 4]; 4] {
    std::array::from_fn(|column| std::array::from_fn(|lane| number(&value[4 * column + lane])))
}
