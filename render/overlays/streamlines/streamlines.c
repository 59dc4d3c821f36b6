#include "render/overlays/streamlines/streamlines.h"

#include "render/frame/frame.h"
#include "render/overlays/streamlines/streamlines_private.h"
#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/streamlines/streamlines_bindings.h"
#include "sim/base/key_rows.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const at_names[] = {[STREAMLINES_PLANE] = "plane", [STREAMLINES_GRID] = "grid", NULL};
static const char *const color_names[] = {
    [STREAMLINES_BY_SCALAR] = "scalar", [STREAMLINES_PLAIN] = "plain", NULL};

const StreamlinesDef streamlines_usual = {
    .slowest = 1e-3, .width = 1.5, .plane_normal = {0, 0, 1}, .color = {0.02, 0.02, 0.025}};

#define AT(field) offsetof(StreamlinesDef, field)

/* clang-format off */
const Key streamlines_keys[] = {
    MAPPING("view.streamlines", "of the overlay streamlines: lines along the velocity of the present state, beside any view"),
    BOOLEAN("view.streamlines.show", L, AT(show), "draw them"),
    CHOICE_OF("view.streamlines.at", L | KEY_INDEX, at_names, AT(at), "where lines have their seeds, evenly spread: plane: on a plane; grid: through the box"),
    NUMBER("view.streamlines.cell", L, "m", 0, 1e6, AT(cell), "from seed to seed; auto, 0: a 16th of the box's longest side", .zero = "auto"),
    NUMBER("view.streamlines.length", L, "m", 0, 1e6, AT(length), "of a line, each way from its seed; auto, 0: the box's longest side", .zero = "auto"),
    NUMBER("view.streamlines.step", L, "m", 0, 1e6, AT(step), "from point to point; auto, 0: the particles' spacing", .zero = "auto"),
    NUMBER("view.streamlines.slowest", L, "", 0, 1, AT(slowest), "a line ends where the speed is below this share of the fastest seed's"),
    NUMBER("view.streamlines.width", L, "pixels", 0, 50, AT(width), "of the lines"),
    BOOLEAN("view.streamlines.in_plane", L, AT(in_plane), "with at: plane, lines keep to the plane: they follow the velocity's part along the plane"),
    VEC3("view.streamlines.plane_point", L, "m", -1e6, 1e6, AT(plane_point), "that the plane goes through, in the box's frame"),
    VEC3("view.streamlines.plane_normal", L, "", -1e6, 1e6, AT(plane_normal), "across the plane, of any length but 0"),
    CHOICE_OF("view.streamlines.color_by", L | KEY_INDEX, color_names, AT(color_by), "scalar: by view.color_by; plain: all alike"),
    COLOR("view.streamlines.color", L, AT(color), NULL, "of plain ones, sRGB: [red, green, blue], each 0 to 1"),
    KEYS_END,
};
/* clang-format on */

typedef struct Streamlines {
    StreamLines lines;
    unsigned program;
    ColorTable colors;
    QuadIndices quads;
} Streamlines;

static void destroy(void *state)
{
    Streamlines *streamlines = state;
    stream_lines_destroy(&streamlines->lines);
    glDeleteProgram(streamlines->program);
    color_table_destroy(&streamlines->colors);
    quad_indices_destroy(&streamlines->quads);
    free(streamlines);
}

static void *create(const Subject *subject, Error *error)
{
    Streamlines *streamlines = calloc(1, sizeof *streamlines);
    (void)subject;
    if (!streamlines) {
        error_set(error, "out of memory for streamlines");
        return NULL;
    }
    quad_indices_create(&streamlines->quads);
    streamlines->program = program_create_pair("streamlines", "streamlines/streamlines.vert",
                                               "streamlines/streamlines.frag", error);
    if (streamlines->program && stream_lines_create(&streamlines->lines, error))
        return streamlines;
    destroy(streamlines);
    return NULL;
}

static void set_look(const Streamlines *streamlines, const ParticleBuffers *particles, const Frame *frame)
{
    const StreamlinesDef *def = streamlines_def(frame->def);
    const Scalar shown = view_color_by(frame->def);
    const bool plain =
        def->color_by == STREAMLINES_PLAIN || !particle_color_attribute(particles, shown)->buffer;
    const bool lifted = def->at == STREAMLINES_PLANE && def->in_plane;
    glUseProgram(streamlines->program);
    glUniform1ui(STREAM_STEPS_AT, (GLuint)streamlines->lines.steps);
    glUniform1f(HALF_WIDTH_AT, (float)(0.5 * def->width));
    glUniform1f(STREAM_LIFT_AT, lifted ? (float)(0.5 * particles->spacing) : 0);
    glUniform1ui(STREAM_IS_FLUID_AT, shown == SCALAR_FLUID);
    glUniform4f(STREAM_COLOR_AT, (float)def->color[0], (float)def->color[1], (float)def->color[2], plain);
}

static void draw_lines(Streamlines *streamlines, const ParticleBuffers *particles, const Frame *frame)
{
    const StreamLines *lines = &streamlines->lines;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(frame->slab > 0 ? GL_ALWAYS : GL_GEQUAL); /* two dimensions: particles do not hide lines */
    glDepthMask(GL_TRUE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    set_look(streamlines, particles, frame);
    color_table_update(&streamlines->colors, view_colormap(frame->def), &frame->def->color_curve);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, STREAM_POINTS_STORAGE, lines->points);
    quad_indices_draw(&streamlines->quads, lines->lines * 2 * (size_t)lines->steps);
    glDisable(GL_BLEND);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    Streamlines *streamlines = state;
    GL_STAGE(frame->timer, STAGE_OVERLAY)
    {
        stream_lines_make(&streamlines->lines, particles, frame);
        if (streamlines->lines.lines > 0)
            draw_lines(streamlines, particles, frame);
    }
}

static void legend(void *state, const Frame *frame, char *line, size_t size)
{
    const StreamLines *lines = &((const Streamlines *)state)->lines;
    (void)frame;
    if (lines->lines == 0)
        snprintf(line, size, "no streamlines");
    else
        snprintf(line, size, "streamlines, a seed each %.3g m%s%s", lines->seeds.cell,
                 lines->seeds.coarser ? "; view.streamlines.cell has too many" : "",
                 lines->shorter ? "; shorter than view.streamlines.length" : "");
}

static bool check(const Subject *subject, const char **key, Error *error)
{
    const StreamlinesDef *def = streamlines_def(subject->def);
    const double *normal = def->plane_normal;
    *key = "view.streamlines.plane_normal";
    return def->at != STREAMLINES_PLANE || normal[0] != 0 || normal[1] != 0 || normal[2] != 0 ||
           error_set(error, "a normal of length 0 is across no plane; [0, 0, 1] looks along z");
}

static void wants(const ViewDef *def, ParticleWants *wants)
{
    (void)def;
    wants->vectors |= VECTOR_BIT(VECTOR_VELOCITY);
    wants->neighbours = true;
}

const OverlayKind overlay_streamlines = {
    .name = "streamlines",
    .help = "lines along the velocity of one state",
    .keys = streamlines_keys,
    .def = &streamlines_usual,
    .def_size = sizeof streamlines_usual,
    .wants = wants,
    .check = check,
    .create = create,
    .destroy = destroy,
    .draw = draw,
    .legend = legend,
};
