#include "render/glyphs/glyph_arrows.h"

#include "render/frame/colormap.h"
#include "shaders/glyphs/glyphs_bindings.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct Glyphs {
    GlyphArrows arrows;
    unsigned program;
    ColorTable colors;
    QuadIndices quads;
    double unit, length; /* an arrow of `length` m means `unit`; 0: no arrows */
    uint32_t left_out;   /* NaN vectors, if legend or scale need the count */
    bool plain;          /* the state lacks the scalar for colours */
} Glyphs;

static void destroy(void *state)
{
    Glyphs *glyphs = state;
    glyph_arrows_destroy(&glyphs->arrows);
    glDeleteProgram(glyphs->program);
    color_table_destroy(&glyphs->colors);
    quad_indices_destroy(&glyphs->quads);
    free(glyphs);
}

static void *create(const Subject *subject, Error *error)
{
    Glyphs *glyphs = calloc(1, sizeof *glyphs);
    (void)subject;
    if (!glyphs) {
        error_set(error, "out of memory for glyphs");
        return NULL;
    }
    quad_indices_create(&glyphs->quads);
    glyphs->program = program_create_pair("glyphs", "glyphs/glyphs.vert", "glyphs/glyphs.frag", error);
    if (glyphs->program && glyph_arrows_create(&glyphs->arrows, error))
        return glyphs;
    destroy(glyphs);
    return NULL;
}

/* An arrow of the usual magnitude is one and a half times as long as the arrows' spacing. */
static void make_scale(Glyphs *glyphs, const ParticleBuffers *particles, const Frame *frame)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    const bool fixed = def->scale > 0;
    const GlyphTally *tally =
        frame->def->legend || !fixed ? glyph_arrows_count(&glyphs->arrows, particles, frame) : NULL;
    glyphs->left_out = tally ? tally->left_out : 0;
    glyphs->length = 1.5 * glyphs->arrows.apart;
    glyphs->unit = fixed ? glyphs->length / def->scale : glyph_usual(tally);
}

static void set_look(const Glyphs *glyphs, const Frame *frame)
{
    static const float tip_length = 0.3F, tip_radius = 0.09F, shaft_radius = 0.035F; /* fractions of the
                                                                                        usual length */
    const GlyphsDef *def = glyphs_def(frame->def);
    const float size = (float)glyphs->length;
    const double lift = frame->slab > 0 ? frame->slab / 2 + (double)tip_radius * glyphs->length : 0;
    glUseProgram(glyphs->program);
    glUniform1f(GLYPH_SCALE_AT, (float)(glyphs->length / glyphs->unit));
    glUniform3f(GLYPH_SIZE_AT, tip_length * size, tip_radius * size, shaft_radius * size);
    glUniform1f(GLYPH_LIFT_AT, (float)lift);
    glUniform1ui(GLYPH_IS_FLUID_AT, view_color_by(frame->def) == SCALAR_FLUID);
    glUniform4f(GLYPH_COLOR_AT, (float)def->color[0], (float)def->color[1], (float)def->color[2],
                def->color_by == GLYPHS_PLAIN || glyphs->plain);
}

static void draw_arrows(Glyphs *glyphs, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    set_look(glyphs, frame);
    color_table_follow(&glyphs->colors, view_colormap(frame->def), &frame->def->color_curve);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLYPH_ARROWS_STORAGE, glyphs->arrows.arrows);
    quad_indices_draw_indirect(&glyphs->quads, glyphs->arrows.most, glyphs->arrows.tallies.box.buffer, 0);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    Glyphs *glyphs = state;
    GL_STAGE(frame->timer, STAGE_OVERLAY)
    {
        glyph_arrows_make(&glyphs->arrows, particles, frame);
        make_scale(glyphs, particles, frame);
        glyphs->plain = !particle_shown(particles, view_color_by(frame->def))->buffer;
        if (glyphs->arrows.most > 0 && glyphs->unit > 0)
            draw_arrows(glyphs, frame);
    }
}

static void legend(void *state, const Frame *frame, char *line, size_t size)
{
    const Glyphs *glyphs = state;
    const ScalarRow *vector = &vector_list[glyphs_def(frame->def)->vector];
    char left_out[64] = "";
    if (glyphs->left_out > 0)
        snprintf(left_out, sizeof left_out, "; %u without a number left out", glyphs->left_out);
    if (glyphs->arrows.most == 0 || !(glyphs->unit > 0))
        snprintf(line, size, "%s: no arrows%s", vector->name, left_out);
    else
        snprintf(line, size, "%s: an arrow of %.3g m is %.3g %s%s%s", vector->name, glyphs->length,
                 glyphs->unit, vector->unit,
                 glyphs->arrows.coarser ? "; coarser than view.glyphs.cell, which has too many" : "",
                 left_out);
}

static bool check(const Subject *subject, const char **key, Error *error)
{
    const GlyphsDef *def = glyphs_def(subject->def);
    const double *normal = def->plane_normal;
    *key = "view.glyphs.plane_normal";
    return def->at != GLYPHS_PLANE || normal[0] != 0 || normal[1] != 0 || normal[2] != 0 ||
           error_set(error, "a normal of length 0 is across no plane; [0, 0, 1] looks along z");
}

/* Ids select the particles with arrows. */
static void wants(const ViewDef *def, ParticleWants *wants)
{
    wants->vectors |= def ? VECTOR_BIT(glyphs_def(def)->vector) : UINT32_MAX;
    if (!def || glyphs_def(def)->at == GLYPHS_PARTICLES)
        wants->attributes |= PARTICLE_ID;
}

const OverlayKind overlay_glyphs = {
    .name = "glyphs",
    .help = "arrows of a vector",
    .keys = glyphs_keys,
    .def = &glyphs_usual,
    .def_size = sizeof glyphs_usual,
    .wants = wants,
    .check = check,
    .create = create,
    .destroy = destroy,
    .draw = draw,
    .legend = legend,
};
