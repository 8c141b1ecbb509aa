"""The part of the program in Rust that draws frames with an engine which writes its calls down.

Each drawing is told in a line of JSON, as ``frame_calls.wrong`` takes it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

from burnish.bindings.fields import Field
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import drawing as drawing_of

from .frame_calls import Drawing, drawings

RECORDER = """\
/// An engine that writes its calls down as JSON.
struct Recorder {
    models: &'static [(&'static str, &'static [&'static str])],
    is_first: bool,
    calls: Vec<String>,
}

fn or_null<T: std::fmt::Debug>(value: Option<T>) -> String {
    value.map_or("null".to_owned(), |value| format!("{value:?}"))
}

fn attachment(each: &Attachment) -> String {
    let Place { texture, layer, level } = each.place;
    let load = if each.clear.is_some() { "clear" } else { "load" };
    let layer = or_null(layer);
    let clear = each.clear.unwrap_or([f32::from(u8::from(each.name == "depth")), 0.0, 0.0, 0.0]);
    format!("[{texture}, {layer}, {level}, {load:?}, {clear:?}, {}]", each.store)
}

fn used(each: &Use) -> String {
    let mut blocks = (each.shader.blocks)();
    let bytes = |blocks: &dyn Blocks| {
        let found = blocks.given().into_iter().map(|block| {
            let mut bytes = Vec::new();
            block.write(&mut bytes);
            bytes
        });
        found.collect::<Vec<_>>()
    };
    let before = bytes(&*blocks);
    each.give(&mut *blocks);
    let reads = each.reads.iter().map(|(name, source)| {
        let (kind, value) = match source {
            Source::Frame(Resource::Texture(number)) => ("texture", number.to_string()),
            Source::Frame(Resource::Buffer(number)) => ("buffer", number.to_string()),
            Source::Host(host) => ("host", format!("{host:?}")),
        };
        format!("{name:?}: {{{kind:?}: {value}}}")
    });
    let reads = reads.collect::<Vec<_>>().join(", ");
    format!("[{:?}, {{{reads}}}, {before:?}, {:?}]", each.shader.name, bytes(&*blocks))
}

fn numbers_of(written: Written) -> String {
    let rows = written.iter().map(|(name, number)| format!("{name:?}: {number}"));
    format!("{{{}}}", rows.collect::<Vec<_>>().join(", "))
}

impl FrameHost for Recorder {
    type Error = &'static str;

    fn begin(
        &mut self,
        _: &'static FrameTable,
        sizes: &[[u32; 2]],
        _: &[usize],
    ) -> Result<bool, Self::Error> {
        self.calls.push(format!("[\\"begin\\", {sizes:?}]"));
        Ok(!self.is_first)
    }

    fn begin_pass(&mut self, pass: &Pass) -> Result<(), Self::Error> {
        let attachments = pass.targets.iter().chain(&pass.depth).map(attachment);
        let attachments = attachments.collect::<Vec<_>>().join(", ");
        let (viewport, scissor) = (or_null(pass.viewport), or_null(pass.scissor));
        let constant = or_null(pass.blend_constant);
        self.calls.push(format!(
            "[\\"pass\\", {:?}, [{attachments}], {viewport}, {scissor}, {constant}]",
            pass.name
        ));
        Ok(())
    }

    fn draw_models(&mut self, tag: &'static str, uses: &[Use]) -> Result<(), Self::Error> {
        for (material, _) in self.models.iter().filter(|(_, tags)| tags.contains(&tag)) {
            let found = uses.iter().find(|each| each.material == Some(material)).ok_or("no use")?;
            self.calls.push(format!("[\\"draw\\", {}, null]", used(found)));
        }
        Ok(())
    }

    fn fill(&mut self, each: &Use, vertices: u32) -> Result<(), Self::Error> {
        self.calls.push(format!("[\\"draw\\", {}, {}]", used(each), vertices / 3));
        Ok(())
    }

    fn end_pass(&mut self) -> Result<(), Self::Error> {
        self.calls.push("[\\"end pass\\"]".to_owned());
        Ok(())
    }

    fn dispatch(
        &mut self,
        each: &Use,
        groups: [u32; 3],
        images: Written,
        _: Written,
    ) -> Result<(), Self::Error> {
        let images = numbers_of(images);
        self.calls.push(format!("[\\"dispatch\\", {}, {groups:?}, {images}]", used(each)));
        Ok(())
    }

    fn copy(&mut self, from: usize, to: usize) -> Result<(), Self::Error> {
        self.calls.push(format!("[\\"copy\\", {from}, {to}]"));
        Ok(())
    }

    fn end(&mut self, _: &'static FrameTable) -> Result<(), Self::Error> {
        self.calls.push("[\\"end\\"]".to_owned());
        println!("[{}]", self.calls.join(", "));
        Ok(())
    }
}
"""

Reads = Callable[[Field, str, Spelling], Iterator[str]]
"""Prints the statements that read a field."""


def drawers(spelling: Spelling, reads: Reads) -> str:
    """The functions that draw, one for each drawing, and one that calls them all."""
    functions = [_drawer(number, each, spelling, reads) for number, each in enumerate(drawings())]
    calls = "".join(f"    draw_{number}(numbers);\n" for number in range(len(functions)))
    everything = f"fn draw_all(numbers: &mut Numbers) {{\n{calls}}}\n"
    return "".join((*functions, everything))


def _drawer(number: int, drawing: Drawing, spelling: Spelling, reads: Reads) -> str:
    frame = drawing.frame
    lines = [f"let mut given = {spelling.type(frame.parameters.name)}::DEFAULT;"]
    for field in _given(drawing):
        lines += reads(field, f"given.{spelling.member(field.word)}", spelling)
    models = ", ".join(
        f"({json.dumps(each['material'])}, &[{', '.join(map(json.dumps, each['tags']))}])"
        for each in drawing.models
    )
    lines += [
        f"const MODELS: &[(&str, &[&str])] = &[{models}];",
        f"let is_first = {json.dumps(drawing.first)};",
        "let mut host = Recorder { models: MODELS, is_first, calls: Vec::new() };",
        f"{spelling.function(drawing_of(frame))}(&mut host, &given).unwrap();",
    ]
    body = "".join(f"    {line}\n" for line in lines)
    head = "#[allow(unused_mut, unused_variables)]\n"
    return f"{head}fn draw_{number}(numbers: &mut Numbers) {{\n{body}}}\n"


def values() -> Iterator[tuple[Any, ...]]:
    """The numbers that the functions read, in their order."""
    for drawing in drawings():
        yield tuple(drawing.values[field.word] for field in _given(drawing))


def _given(drawing: Drawing) -> Iterator[Field]:
    fields = drawing.frame.parameters.structure.fields
    return (field for field in fields if field.word in drawing.values)
