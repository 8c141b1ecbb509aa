//! Draws the frame `Shadows`: the binding calls this engine step by step.

use serde_json::Value;
use wgpu::*;

use crate::shaders::{self, for_wgpu, FrameHost, FrameTable, Pass, Resource, Source, Use, Written};
use crate::{lanes, list, text, Host, Textures, Told};

/// Two balls on a floor, in the light of a lamp and its shadow map.
pub fn draw(host: &Host, scene: &Value) -> Told<Texture> {
    let lamp = &scene["lights"]["lamp"];
    let parameters = shaders::ShadowsParameters {
        size: host.size().map(|side| side as i32),
        lamp_place: lanes(&lamp["place"]),
        lamp_axis: lanes(&lamp["axis"]),
        ..shaders::ShadowsParameters::DEFAULT
    };
    parameters.check()?;
    let encoder = host.device.create_command_encoder(&Default::default());
    let models = list(&scene["models"], Value::clone);
    let mut engine = Engine {
        host,
        models,
        encoder,
        textures: Vec::new(),
        pass: None,
        targets: Vec::new(),
    };
    shaders::draw_shadows(&mut engine, &parameters)?;
    host.queue.submit([engine.encoder.finish()]);
    let (_, Resource::Texture(picture)) = shaders::SHADOWS_FRAME.outputs[0] else {
        return Err("the frame has no picture".into());
    };
    Ok(engine.textures.swap_remove(picture))
}

struct Engine<'a> {
    host: &'a Host<'a>,
    models: Vec<Value>,
    encoder: CommandEncoder,
    textures: Vec<Texture>,
    /// The pass that draws now, and the formats of its targets.
    pass: Option<RenderPass<'static>>,
    targets: Vec<TextureFormat>,
}

impl Engine<'_> {
    /// The textures that a shader reads.
    fn read(&self, used: &Use) -> Textures {
        let view = |(name, source): &(&'static str, Source)| match source {
            Source::Frame(Resource::Texture(number)) => Some((
                *name,
                self.textures[*number].create_view(&Default::default()),
            )),
            _ => None,
        };
        used.reads.iter().filter_map(view).collect()
    }
}

impl FrameHost for Engine<'_> {
    type Error = Box<dyn std::error::Error>;

    fn begin(&mut self, frame: &'static FrameTable, sizes: &[[u32; 2]], _: &[usize]) -> Told<bool> {
        let made = |(row, size)| {
            for_wgpu::frame_texture(&self.host.device, row, size, TextureUsages::COPY_SRC)
        };
        self.textures = frame
            .textures
            .iter()
            .zip(sizes.iter().copied())
            .map(made)
            .collect();
        Ok(false)
    }

    fn begin_pass(&mut self, pass: &Pass) -> Told<()> {
        self.targets = pass
            .targets
            .iter()
            .map(|each| self.textures[each.place.texture].format())
            .collect();
        self.pass = Some(for_wgpu::begin_pass(
            &mut self.encoder,
            pass,
            &self.textures,
        ));
        Ok(())
    }

    fn draw_models(&mut self, _: &'static str, uses: &[Use]) -> Told<()> {
        let mut pass = self.pass.take().ok_or("there is no pass")?;
        for model in &self.models {
            let material = text(&model["material"]);
            let used = uses.iter().find(|each| each.material == Some(material));
            let used = used.ok_or_else(|| format!("the frame has no material `{material}`"))?;
            let mut blocks = (used.shader.blocks)();
            self.host.place(&mut *blocks, model);
            used.give(&mut *blocks);
            let textures = self.read(used);
            self.host.draw_model(
                &mut pass,
                used.shader,
                &*blocks,
                &textures,
                model,
                &self.targets,
            )?;
        }
        self.pass = Some(pass);
        Ok(())
    }

    fn end_pass(&mut self) -> Told<()> {
        self.pass = None;
        Ok(())
    }

    fn end(&mut self, _: &'static FrameTable) -> Told<()> {
        Ok(())
    }

    // What this frame does not do.

    fn fill(&mut self, _: &Use, _: u32) -> Told<()> {
        Err("this engine fills no pictures".into())
    }

    fn dispatch(&mut self, _: &Use, _: [u32; 3], _: Written, _: Written) -> Told<()> {
        Err("this engine runs no kernels".into())
    }

    fn copy(&mut self, _: usize, _: usize) -> Told<()> {
        Err("this engine copies no textures".into())
    }
}
