#include "render/overlays/glyphs/glyphs.h"

#include "render/frame/frame.h"
#include "render/overlays/glyphs/glyphs_private.h"
#include "render/particles/particles.h"
#include "shaders/glyphs/glyphs_bindings.h"
#include "shaders/shared/bindings.h"
#include "sim/base/key_rows.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const at_names[] = {
    [GLYPHS_PARTICLES] = "particles", [GLYPHS_GRID] = "grid", [GLYPHS_PLANE] = "plane", NULL};
static const char *const color_names[] = {[GLYPHS_BY_SCALAR] = "scalar", [GLYPHS_PLAIN] = "plain", NULL};

const GlyphsDef glyphs_usual = {.stride = 20, .plane_normal = {0, 0, 1}, .color = {0.02, 0.02, 0.025}};

#define AT(field) offsetof(GlyphsDef, field)

/* clang-format off */
const Key glyphs_keys[] = {
    MAPPING("view.glyphs", "of the overlay glyphs: arrows of a vector, beside any view"),
    BOOLEAN("view.glyphs.show", L, AT(show), "draw them"),
    CHOICE_OF("view.glyphs.vector", L | KEY_INDEX, vector_list, AT(vector), "velocity: of the fluid in the box; vorticity: its curl; pressure_gradient; box_velocity: of the box itself where the fluid is, by the world's frame"),
    CHOICE_OF("view.glyphs.at", L | KEY_INDEX, at_names, AT(at), "particles: at every so many of them; grid, plane: means of the fluid around, evenly spread through the box or on a plane"),
    INTEGER("view.glyphs.stride", L, 1, 1000000, AT(stride), "every so many particles, by their ids, has one"),
    NUMBER("view.glyphs.cell", L, "m", 0, 1e6, AT(cell), "from arrow to arrow on a grid or a plane; auto, 0: a 24th of the box's longest side", .zero = "auto"),
    NUMBER("view.glyphs.scale", L, "", 0, 1e12, AT(scale), "m in a unit of the vector; auto, 0: so that of twenty arrows one is longer than 1.5 times the way from one to the next, about; the legend has it in either case", .zero = "auto"),
    VEC3("view.glyphs.plane_point", L, "m", -1e6, 1e6, AT(plane_point), "that the plane goes through, in the box's frame"),
    VEC3("view.glyphs.plane_normal", L, "", -1e6, 1e6, AT(plane_normal), "across the plane, of any length but 0"),
    CHOICE_OF("view.glyphs.color_by", L | KEY_INDEX, color_names, AT(color_by), "scalar: by view.color_by; plain: all alike"),
    COLOR("view.glyphs.color", L, AT(color), NULL, "of plain ones, sRGB: [red, green, blue], each 0 to 1"),
    KEYS_END,
};
/* clang-format on */

GlyphsDef *glyphs_def(const ViewDef *def)
{
    return overlay_own_settings(def, &overlay_glyphs);
}

/* Returns false if memory is short; call glyph_tallies_destroy in either case. */
static bool glyph_tallies_create(GlyphTallies *tallies, Error *error)
{
    return mailbox_create(&tallies->box, "glyphs' command",
                          sizeof(uint32_t[GLYPH_COMMAND_WORDS]) + sizeof(GlyphTally)) ||
           error_set(error, "the GPU has no memory for glyphs");
}

static void glyph_tallies_destroy(GlyphTallies *tallies)
{
    mailbox_destroy(&tallies->box);
    *tallies = (GlyphTallies){0};
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* True if both give the same arrows. */
static bool same_def(const GlyphsDef *a, const GlyphsDef *b)
{
    return a->vector == b->vector && a->at == b->at && a->stride == b->stride && a->cell == b->cell &&
           same3(a->plane_point, b->plane_point) && same3(a->plane_normal, b->plane_normal);
}

static bool same_source(const GlyphTallySource *a, const GlyphTallySource *b)
{
    return a->step == b->step && a->time == b->time && a->count == b->count &&
           a->vectors.buffer == b->vectors.buffer && a->vectors.offset == b->vectors.offset &&
           same_def(&a->def, &b->def);
}

/* Takes an answer; NULL: none will come, since the context is lost. */
static void take_tally(GlyphTallies *tallies, const void *came)
{
    tallies->tally = (GlyphTally){{0}, 0};
    if (came)
        memcpy(&tallies->tally, (const uint32_t *)came + GLYPH_COMMAND_WORDS, sizeof tallies->tally);
    tallies->of = tallies->asked;
    tallies->known = true;
}

static void look_at_tally(GlyphTallies *tallies)
{
    const bool under_way = tallies->box.fence != NULL;
    const void *came = mailbox_look(&tallies->box);
    if (under_way && !tallies->box.fence)
        take_tally(tallies, came);
}

/* The tally of the arrows just made, for the same state. If frame->stale is NULL, waits for the GPU. Else
   waits only for the first tally of a vector, since vectors have different units. Later tallies may be of
   an earlier state or earlier settings; then *frame->stale becomes true. Valid until the next call. */
static const GlyphTally *glyph_tallies_update(GlyphTallies *tallies, const ParticleBuffers *particles,
                                              const Frame *frame)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    const GlyphTallySource now = {particles->step, particles->time, particles->count,
                                  particles->vector[def->vector], *def};
    const bool waits = !frame->stale || !tallies->known || tallies->of.def.vector != def->vector;
    look_at_tally(tallies);
    if (waits || (!tallies->box.fence && !same_source(&tallies->of, &now))) {
        mailbox_send(&tallies->box);
        tallies->asked = now;
    }
    if (waits)
        take_tally(tallies, mailbox_wait(&tallies->box));
    else
        *frame->stale |= !same_source(&tallies->of, &now);
    return &tallies->tally;
}

static double round_up(double x)
{
    static const double rounds[] = {1, 1.5, 2, 3, 5, 7};
    const double power = pow(10, floor(log10(x)));
    for (size_t i = 0; i < sizeof rounds / sizeof *rounds; i++)
        if (x <= 1.0001 * rounds[i] * power)
            return rounds[i] * power;
    return 10 * power;
}

double glyph_typical_magnitude(const GlyphTally *tally)
{
    uint64_t all = 0, below = 0;
    int bin = 0;
    for (int i = 0; i < GLYPH_BINS; i++)
        all += tally->bins[i];
    for (; bin < GLYPH_BINS && 20 * below < 19 * all; bin++)
        below += tally->bins[bin];
    return all > 0 ? round_up(exp2((bin - 0.5 * GLYPH_BINS) / GLYPH_OCTAVE_BINS)) : 0;
}

enum { SAMPLES_MOST = 1000000, USUAL_SAMPLES = 24 };

bool glyph_arrows_create(GlyphArrows *arrows, Error *error)
{
    static const char *const particles[] = {"glyphs/glyphs_particles.comp", NULL};
    static const char *const samples[] = {"glyphs/glyphs_samples.comp", NULL};
    arrows->particles = program_create("glyphs of particles", particles, NULL, error);
    arrows->samples = arrows->particles ? program_create("glyphs of samples", samples, NULL, error) : 0;
    return arrows->samples && glyph_tallies_create(&arrows->tallies, error);
}

void glyph_arrows_destroy(GlyphArrows *arrows)
{
    glDeleteProgram(arrows->particles);
    glDeleteProgram(arrows->samples);
    glDeleteBuffers(1, &arrows->arrows);
    glyph_tallies_destroy(&arrows->tallies);
    glDeleteBuffers(1, &arrows->no_scalar);
    *arrows = (GlyphArrows){0};
}

static void reserve_arrows(GlyphArrows *arrows, size_t count)
{
    enum { ARROW_BYTES = 8 * sizeof(float) };
    if (!arrows->no_scalar)
        work_buffer_remake(&arrows->no_scalar, sizeof(uint32_t[4]), "glyphs without a scalar");
    if (count <= arrows->capacity)
        return;
    arrows->capacity = work_capacity(arrows->capacity, count);
    work_buffer_remake(&arrows->arrows, arrows->capacity * ARROW_BYTES, "glyphs");
}

/* No arrow yet: one instance of no index. */
static void begin(const GlyphArrows *arrows)
{
    static const uint32_t none = 0, one = 1;
    const unsigned command = arrows->tallies.box.buffer;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glClearNamedBufferData(command, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    glClearNamedBufferSubData(command, GL_R32UI, sizeof one, sizeof one, GL_RED_INTEGER, GL_UNSIGNED_INT,
                              &one);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLYPH_COMMAND_STORAGE, command);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLYPH_ARROWS_STORAGE, arrows->arrows);
}

/* The vector shown; buffer 0: the state lacks the vector. */
static const ParticleAttribute *vector_of(const ParticleBuffers *particles, const Frame *frame)
{
    return &particles->vector[glyphs_def(frame->def)->vector];
}

static void set_vector(const GlyphArrows *arrows, GLuint program, const ParticleBuffers *particles,
                       const Frame *frame)
{
    vectors_bind(program, particles, glyphs_def(frame->def)->vector, view_color_by(frame->def),
                 arrows->no_scalar);
}

static void of_particles(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame)
{
    const int stride = glyphs_def(frame->def)->stride;
    const double dimensions = frame->slab > 0 ? 2 : 3;
    arrows->apart = particles->spacing * pow(stride, 1 / dimensions);
    arrows->most = particles->count;
    reserve_arrows(arrows, arrows->most);
    begin(arrows);
    set_vector(arrows, arrows->particles, particles, frame);
    particle_bind_one(GLYPH_IDS_STORAGE, &particles->id, particles->count, 0);
    glUseProgram(arrows->particles);
    glUniform1ui(GLYPH_COUNT_AT, (GLuint)particles->count);
    glUniform1ui(GLYPH_ID_STRIDE_AT, (GLuint)(particles->id.stride / 4));
    glUniform1ui(GLYPH_EVERY_AT, (GLuint)stride);
    work_run(particles->count);
}

/* Returns false if there are no samples: the plane misses the box. */
static bool make_samples(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame,
                         SampleGrid *samples)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    const double *box = particles->box_size, longest = fmax(box[0], fmax(box[1], box[2]));
    const bool on_plane = def->at == GLYPHS_PLANE;
    Plane plane;
    if (on_plane && !plane_make(box, def->plane_point, def->plane_normal, &plane))
        return false;
    sample_grid_make(samples, box, on_plane ? &plane : NULL,
                     def->cell > 0 ? def->cell : longest / USUAL_SAMPLES, SAMPLES_MOST);
    arrows->coarser = samples->coarser;
    arrows->apart = samples->cell;
    return true;
}

static void of_samples(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame)
{
    SampleGrid samples;
    if (!make_samples(arrows, particles, frame, &samples))
        return;
    arrows->most = sample_grid_places(&samples);
    reserve_arrows(arrows, arrows->most);
    neighbourhood_build(frame->neighbourhood, particles);
    begin(arrows);
    set_vector(arrows, arrows->samples, particles, frame);
    sample_grid_set(&samples, arrows->samples);
    mean_set(arrows->samples, particles->support_radius, frame->slab > 0 ? 2 : 3);
    neighbourhood_run_for(frame->neighbourhood, arrows->samples, arrows->most);
}

void glyph_arrows_make(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    arrows->most = 0;
    arrows->coarser = false;
    if (particles->count == 0 || !vector_of(particles, frame)->buffer)
        return;
    if (def->at == GLYPHS_PARTICLES && particles->id.buffer)
        of_particles(arrows, particles, frame);
    else if (def->at != GLYPHS_PARTICLES)
        of_samples(arrows, particles, frame);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

const GlyphTally *glyph_arrows_count(GlyphArrows *arrows, const ParticleBuffers *particles,
                                     const Frame *frame)
{
    static const GlyphTally none;
    return arrows->most > 0 ? glyph_tallies_update(&arrows->tallies, particles, frame) : &none;
}

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
    glyphs->unit = fixed ? glyphs->length / def->scale : glyph_typical_magnitude(tally);
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
    color_table_update(&glyphs->colors, view_colormap(frame->def), &frame->def->color_curve);
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
        glyphs->plain = !particle_color_attribute(particles, view_color_by(frame->def))->buffer;
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
    wants->neighbours |= def && glyphs_def(def)->at != GLYPHS_PARTICLES;
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
