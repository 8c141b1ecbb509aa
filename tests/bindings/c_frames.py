"""Frames in C: the part of the test's program that draws them.

An engine writes its calls down as JSON, each in a line, as the one in C++ does:
``cpp_frames.calls`` reads both.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator

from burnish.bindings.materials import Material
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import blocks_of
from burnish.bindings.writing import drawing as drawing_of

from .cpp_frames import MARK, fields
from .frame_calls import drawings

_RECORDER = """\
typedef struct Model { const char* material; const char* tags[8]; } Model;
typedef struct Engine { const Model* models; int model_count; bool is_first; } Engine;
static void comma(int i) { if (i > 0) printf(", "); }
static void list(const float* lanes, int count) {
    printf("[");
    for (int i = 0; i < count; ++i) { comma(i); printf("%.9g", (double)lanes[i]); }
    printf("]");
}
static void whole_list(const int* lanes, int count) {
    printf("[");
    for (int i = 0; i < count; ++i) { comma(i); printf("%d", lanes[i]); }
    printf("]");
}
static bool begin(
    void* user, const burnish_Frame* frame, const int (*sizes)[2], const int* counts
) {
    (void)counts;
    printf("[\\"begin\\", [");
    for (int i = 0; i < frame->texture_count; ++i) { comma(i); whole_list(sizes[i], 2); }
    puts("]]");
    return !((Engine*)user)->is_first;
}
static void attachment(const burnish_Attachment* each) {
    printf("[%d, ", each->texture);
    if (each->layer < 0) printf("null"); else printf("%d", each->layer);
    printf(", %d, \\"%s\\", ", each->level, each->is_cleared ? "clear" : "load");
    list(each->clear, 4);
    printf(", %s]", each->is_stored ? "true" : "false");
}
static void begin_pass(void* user, const burnish_Pass* pass) {
    (void)user;
    printf("[\\"pass\\", \\"%s\\", [", pass->name);
    for (int i = 0; i < pass->target_count; ++i) { comma(i); attachment(&pass->targets[i]); }
    if (pass->depth) { comma(pass->target_count); attachment(pass->depth); }
    printf("]");
    const float* rows[] = {pass->viewport, pass->scissor, pass->blend_constant};
    for (int i = 0; i < 3; ++i) {
        printf(", ");
        if (rows[i]) list(rows[i], 4); else printf("null");
    }
    puts("]");
}
static void hexadecimal(const void* block, size_t size) {
    printf("\\"");
    for (size_t i = 0; i < size; ++i) printf("%02x", ((const unsigned char*)block)[i]);
    printf("\\"");
}
static void given(const burnish_Material* shader, const void* all);
static void used(const burnish_Use* use) {
    void* blocks = malloc(use->shader->blocks_size);
    use->shader->make_blocks(blocks);
    printf("[\\"%s\\", {", use->shader->name);
    for (int i = 0; i < use->read_count; ++i) {
        const burnish_Source* source = &use->reads[i].source;
        comma(i);
        printf("\\"%s\\": ", use->reads[i].name);
        if (source->from == BURNISH_FROM_HOST) printf("{\\"host\\": \\"%s\\"}", source->name);
        if (source->from == BURNISH_FROM_BUFFER) printf("{\\"buffer\\": %d}", source->number);
        if (source->from == BURNISH_FROM_TEXTURE) printf("{\\"texture\\": %d}", source->number);
    }
    printf("}, ");
    given(use->shader, blocks);
    burnish_give(use, blocks);
    printf(", ");
    given(use->shader, blocks);
    printf("]");
    free(blocks);
}
static bool has_tag(const Model* model, const char* tag) {
    for (int i = 0; model->tags[i] != NULL; ++i) if (strcmp(model->tags[i], tag) == 0) return true;
    return false;
}
static void draw_models(void* user, const char* tag, const burnish_Use* uses, int use_count) {
    const Engine* engine = (const Engine*)user;
    for (int m = 0; m < engine->model_count; ++m) {
        if (!has_tag(&engine->models[m], tag)) continue;
        for (int i = 0; i < use_count; ++i) {
            if (strcmp(engine->models[m].material, uses[i].material) != 0) continue;
            printf("[\\"draw\\", ");
            used(&uses[i]);
            puts(", null]");
        }
    }
}
static void fill(void* user, const burnish_Use* use, int vertices) {
    (void)user;
    printf("[\\"draw\\", ");
    used(use);
    printf(", %d]\\n", vertices / 3);
}
static void end_pass(void* user) { (void)user; puts("[\\"end pass\\"]"); }
static void dispatch(
    void* user, const burnish_Use* use, const int* groups, const burnish_Written* images,
    int image_count, const burnish_Written* buffers, int buffer_count
) {
    (void)user, (void)buffers, (void)buffer_count;
    printf("[\\"dispatch\\", ");
    used(use);
    printf(", ");
    whole_list(groups, 3);
    printf(", {");
    for (int i = 0; i < image_count; ++i) {
        comma(i);
        printf("\\"%s\\": %d", images[i].name, images[i].number);
    }
    puts("}]");
}
static void copy(void* user, int from, int to) {
    (void)user;
    printf("[\\"copy\\", %d, %d]\\n", from, to);
}
static void end(void* user, const burnish_Frame* frame) {
    (void)user, (void)frame;
    puts("[\\"end\\"]");
}
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
    parameters = "const burnish_Material* shader, const void* all"
    return f"{_RECORDER}static void given({parameters}) {{\n{tells}}}\n"


def _told(shader: Material, spelling: Spelling) -> str:
    """The statement that tells the blocks of a shader which a host sets."""
    given = [spelling.member(each.plain_name) for each in shader.blocks if not each.derivation]
    parts = ['printf("[");']
    for number, member in enumerate(given):
        place = f"blocks->{member}"
        parts.append(f"comma({number}); hexadecimal(&{place}, sizeof {place});")
    type_ = spelling.type(blocks_of(shader))
    return (
        f"if (shader == &{spelling.constant(shader.name)}) {{ "
        f"const {type_}* blocks = (const {type_}*)all; (void)blocks; "
        f'{" ".join(parts)} printf("]"); }}\n'
    )


def turns(spelling: Spelling, reads: Callable[..., Iterator[str]]) -> Iterator[str]:
    """The statements that read the parameters of each drawing, and draw it."""
    for drawing in drawings():
        frame = drawing.frame
        made = f"{spelling.function(f'default.{frame.parameters.name}')}()"
        yield f"{{ {spelling.type(frame.parameters.name)} parameters = {made};"
        for field in fields(drawing):
            yield from reads(field, f"parameters.{spelling.member(field.word)}", spelling)
        models = ", ".join(
            f"{{{json.dumps(each['material'])}, {{{', '.join(map(json.dumps, each['tags']))}}}}}"
            for each in drawing.models
        )
        count = len(drawing.models)
        yield f"const Model models[] = {{{models or '{NULL, {NULL}}'}}};"
        yield f"Engine engine = {{models, {count}, {str(drawing.first).lower()}}};"
        calls = "begin, begin_pass, draw_models, fill, end_pass, dispatch, copy, end"
        yield f"const burnish_FrameHost host = {{&engine, {calls}}};"
        yield f'puts("{MARK}");'
        yield f"{spelling.function(drawing_of(frame))}(&host, &parameters); }}"
