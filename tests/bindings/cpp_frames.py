"""Frames in C++: the part of the test's program that draws them, and what it tells.

An engine writes its calls down as JSON, each in a line, so that ``frame_calls.wrong`` can compare
them with those that Burnish's own host would make.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from burnish.bindings.materials import Material
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import blocks_of
from burnish.bindings.writing import drawing as drawing_of

from .frame_calls import Drawing, drawings
from .given import lanes

MARK = "frame"
"""The line before the calls of a drawing."""
_RECORDER = """\
struct Model {
    std::string_view material;
    std::vector<std::string_view> tags;
};
class Recorder : public burnish::FrameHost {
public:
    Recorder(std::vector<Model> models, bool is_first) : models_(models), is_first_(is_first) {}
    bool begin(const burnish::Frame&, const std::vector<std::array<int, 2>>& sizes,
               const std::vector<int>&) override {
        std::printf("[\\"begin\\", [");
        for (std::size_t i = 0; i < sizes.size(); ++i) { comma(i); list(sizes[i]); }
        std::puts("]]");
        return !is_first_;
    }
    void begin_pass(const burnish::Pass& pass) override {
        std::printf("[\\"pass\\", \\"%s\\", [", pass.name);
        for (std::size_t i = 0; i < pass.targets.size(); ++i) {
            comma(i);
            attachment(pass.targets[i]);
        }
        if (pass.depth) { comma(pass.targets.size()); attachment(*pass.depth); }
        std::printf("]");
        for (const auto& each : {pass.viewport, pass.scissor, pass.blend_constant}) {
            std::printf(", ");
            each ? list(*each) : void(std::printf("null"));
        }
        std::puts("]");
    }
    void draw_models(const char* tag, const std::vector<burnish::Use>& uses) override {
        for (const Model& model : models_) {
            if (std::find(model.tags.begin(), model.tags.end(), tag) == model.tags.end()) continue;
            for (const burnish::Use& use : uses) {
                if (model.material != use.material) continue;
                std::printf("[\\"draw\\", ");
                used(use);
                std::puts(", null]");
            }
        }
    }
    void fill(const burnish::Use& use, int vertices) override {
        std::printf("[\\"draw\\", ");
        used(use);
        std::printf(", %d]\\n", vertices / 3);
    }
    void end_pass() override { std::puts("[\\"end pass\\"]"); }
    void dispatch(const burnish::Use& use, std::array<int, 3> groups,
                  const std::vector<burnish::Written>& images,
                  const std::vector<burnish::Written>&) override {
        std::printf("[\\"dispatch\\", ");
        used(use);
        std::printf(", ");
        list(groups);
        std::printf(", {");
        for (std::size_t i = 0; i < images.size(); ++i) {
            comma(i);
            std::printf("\\"%s\\": %d", images[i].name, images[i].number);
        }
        std::puts("}]");
    }
    void copy(int from, int to) override { std::printf("[\\"copy\\", %d, %d]\\n", from, to); }
    void end(const burnish::Frame&) override { std::puts("[\\"end\\"]"); }

private:
    static void comma(std::size_t i) { if (i > 0) std::printf(", "); }
    template <class Lanes> static void list(const Lanes& lanes) {
        std::printf("[");
        for (std::size_t i = 0; i < lanes.size(); ++i) {
            comma(i);
            std::printf("%.9g", double(lanes[i]));
        }
        std::printf("]");
    }
    static void attachment(const burnish::Attachment& each) {
        std::printf("[%d, ", each.texture);
        each.layer < 0 ? std::printf("null") : std::printf("%d", each.layer);
        std::printf(", %d, \\"%s\\", ", each.level, each.is_cleared ? "clear" : "load");
        list(each.clear);
        std::printf(", %s]", each.is_stored ? "true" : "false");
    }
    static void used(const burnish::Use& use) {
        const auto blocks = use.shader->make_blocks();
        std::printf("[\\"%s\\", {", use.shader->name);
        for (std::size_t i = 0; i < use.reads.size(); ++i) {
            comma(i);
            const auto& [from, number, name] = use.reads[i].source;
            std::printf("\\"%s\\": ", use.reads[i].name);
            using From = burnish::Source::From;
            if (from == From::host) std::printf("{\\"host\\": \\"%s\\"}", name);
            if (from == From::buffer) std::printf("{\\"buffer\\": %d}", number);
            if (from == From::texture) std::printf("{\\"texture\\": %d}", number);
        }
        std::printf("}, ");
        given(use.shader, *blocks);
        use.give(*blocks);
        std::printf(", ");
        given(use.shader, *blocks);
        std::printf("]");
    }
    template <class Block> static void hexadecimal(const Block& block) {
        const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&block);
        std::printf("\\"");
        for (std::size_t i = 0; i < sizeof(Block); ++i) std::printf("%02x", bytes[i]);
        std::printf("\\"");
    }
    static void given(const burnish::Material* shader, const burnish::Blocks& all);
    std::vector<Model> models_;
    bool is_first_;
};
"""


def recorder(spelling: Spelling) -> str:
    """The engine that writes its calls down."""
    shaders = {
        use.shader.name: use.shader
        for drawing in drawings()
        for step in drawing.frame.steps
        for use in step.uses
    }
    tells = "".join(_told(shader, spelling) for shader in shaders.values())
    parameters = "const burnish::Material* shader, const burnish::Blocks& all"
    return f"{_RECORDER}void Recorder::given({parameters}) {{\n{tells}}}\n"


def _told(shader: Material, spelling: Spelling) -> str:
    """The statement that tells the blocks of a shader which a host sets."""
    given = [spelling.member(each.plain_name) for each in shader.blocks if not each.derivation]
    parts = ['std::printf("[");']
    for number, member in enumerate(given):
        parts.append(f"comma({number}); hexadecimal(blocks.{member});")
    type_ = spelling.type(blocks_of(shader))
    return (
        f"if (shader == &{spelling.constant(shader.name)}) {{ "
        f"[[maybe_unused]] const auto& blocks = static_cast<const {type_}&>(all); "
        f'{" ".join(parts)} std::printf("]"); }}\n'
    )


def turns(spelling: Spelling, reads: Callable[..., Iterator[str]]) -> Iterator[str]:
    """The statements that read the parameters of each drawing, and draw it."""
    for drawing in drawings():
        frame = drawing.frame
        yield f"{{ {spelling.type(frame.parameters.name)} parameters;"
        for field in fields(drawing):
            yield from reads(field, f"parameters.{spelling.member(field.word)}", spelling)
        models = ", ".join(
            f"{{{json.dumps(each['material'])}, {{{', '.join(map(json.dumps, each['tags']))}}}}}"
            for each in drawing.models
        )
        yield f'std::puts("{MARK}");'
        yield f"Recorder recorder({{{models}}}, {str(drawing.first).lower()});"
        yield f"{spelling.function(drawing_of(frame))}(recorder, parameters); }}"


def fields(drawing: Drawing) -> list[Any]:
    fields = drawing.frame.parameters.structure.fields
    return [each for each in fields if each.word in drawing.values]


def numbers() -> Iterator[str]:
    """The numbers that these statements read."""
    for drawing in drawings():
        yield from lanes(tuple(drawing.values[each.word] for each in fields(drawing)))


def calls(lines: Sequence[str]) -> list[list[Any]]:
    """The calls of each drawing, as the program has told them."""
    found: list[list[Any]] = []
    for line in lines:
        if line == MARK:
            found.append([])
        else:
            found[-1].append(_with_bytes(json.loads(line)))
    return found


def _with_bytes(call: list[Any]) -> list[Any]:
    """A call with the bytes of blocks in place of texts."""
    if call[0] in ("draw", "dispatch"):
        shader, reads, *blocks = call[1]
        call[1] = [shader, reads, *([bytes.fromhex(each) for each in row] for row in blocks)]
    return call
