#include "render/water/water.h"

#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

enum { FIND, SMOOTH, GATHER, COMPOSE };

static const double SMOOTHED = 6; /* half the width in spacings; three standard deviations of the weights */

static void create_light_map(Caustics *caustics, int map, GLenum format, const char *label)
{
    GLuint *texture = &caustics->maps[map], *framebuffer = &caustics->framebuffers[map];
    glCreateTextures(GL_TEXTURE_2D, 1, texture);
    glObjectLabel(GL_TEXTURE, *texture, -1, label);
    glTextureStorage2D(*texture, 1, format, CAUSTIC_TEXELS, CAUSTIC_TEXELS);
    glTextureParameteri(*texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(*texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(*texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(*texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, *framebuffer, -1, label);
    glNamedFramebufferTexture(*framebuffer, GL_COLOR_ATTACHMENT0, *texture, 0);
}

bool caustics_create(Caustics *caustics, Error *error)
{
    static const char *const files[4][2] = {{"common/screen.vert", "water/caustics_height.frag"},
                                            {"common/screen.vert", "water/caustics_smooth.frag"},
                                            {"water/caustics.vert", "water/caustics.frag"},
                                            {"common/screen.vert", "water/caustics_light.frag"}};
    if (caustics->vertex_array)
        return caustics->programs[COMPOSE] != 0;
    glCreateVertexArrays(1, &caustics->vertex_array);
    create_light_map(caustics, CAUSTIC_HEIGHT, GL_RGBA32F, "caustics, height");
    create_light_map(caustics, CAUSTIC_SMOOTH, GL_RGBA32F, "caustics, smooth height");
    create_light_map(caustics, CAUSTIC_FACTOR, GL_R32F, "caustics");
    create_light_map(caustics, CAUSTIC_LIGHT, GL_R32F, "floor light");
    for (int i = 0; i < 4; i++)
        if (!(caustics->programs[i] = program_create_pair("caustics", files[i][0], files[i][1], error)))
            return false;
    return true;
}

void caustics_destroy(void *state)
{
    Caustics *caustics = state;
    for (int i = 0; i < 4; i++)
        glDeleteProgram(caustics->programs[i]);
    glDeleteVertexArrays(1, &caustics->vertex_array);
    glDeleteTextures(CAUSTIC_MAPS, caustics->maps);
    glDeleteFramebuffers(CAUSTIC_MAPS, caustics->framebuffers);
    *caustics = (Caustics){0};
}

static void draw_light_map(const Caustics *caustics, int program, unsigned from, int to)
{
    glBindFramebuffer(GL_FRAMEBUFFER, caustics->framebuffers[to]);
    glBindTextureUnit(CAUSTIC_UNIT, from);
    glUseProgram(caustics->programs[program]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void smooth_heights(const Caustics *caustics, const Frame *frame, double spacing)
{
    const GLuint program = caustics->programs[SMOOTH];
    for (int k = 0; k < 2; k++) {
        const double reach = SMOOTHED * spacing * CAUSTIC_TEXELS / frame->floor.map_size[k];
        glProgramUniform2i(program, CAUSTIC_STEP_AT, k == 0, k == 1);
        glProgramUniform1f(program, CAUSTIC_WIDTH_AT, (float)fmax(reach, 1));
        draw_light_map(caustics, SMOOTH, caustics->maps[k == 0 ? CAUSTIC_HEIGHT : CAUSTIC_SMOOTH],
                       k == 0 ? CAUSTIC_SMOOTH : CAUSTIC_HEIGHT);
    }
}

/* Twice the height above the floor that the fluid would have at rest, m. */
static double highest_surface(const Frame *frame, const ParticleBuffers *particles)
{
    const double *box = particles->box_size, side = particles->spacing;
    const double bottom = particles->box.position[1] - frame->floor.height;
    return fmax(bottom, 0) + 2 * (double)particles->count * side * side * side / (box[0] * box[2]);
}

/* Adds up the light of all points. */
static void gather_light(const Caustics *caustics, const Frame *frame, const ParticleBuffers *particles)
{
    static const float nothing[4] = {0};
    const GLuint program = caustics->programs[GATHER];
    glClearNamedFramebufferfv(caustics->framebuffers[CAUSTIC_FACTOR], GL_COLOR, 0, nothing);
    glBindFramebuffer(GL_FRAMEBUFFER, caustics->framebuffers[CAUSTIC_FACTOR]);
    glBindTextureUnit(CAUSTIC_UNIT, caustics->maps[CAUSTIC_HEIGHT]);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glUseProgram(program);
    glProgramUniform1f(program, REFRACTION_INDEX_AT, frame->fluid.refraction);
    glProgramUniform1f(program, CAUSTIC_HIGHEST_AT, (float)highest_surface(frame, particles));
    glDrawArrays(GL_POINTS, 0, CAUSTIC_TEXELS * CAUSTIC_TEXELS);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, CAUSTIC_TEXELS, CAUSTIC_TEXELS);
    glBindVertexArray(caustics->vertex_array);
    draw_light_map(caustics, FIND, 0, CAUSTIC_HEIGHT);
    smooth_heights(caustics, frame, particles->spacing);
    gather_light(caustics, frame, particles);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor.light);
    draw_light_map(caustics, COMPOSE, caustics->maps[CAUSTIC_FACTOR], CAUSTIC_LIGHT);
    return caustics->maps[CAUSTIC_LIGHT];
}

static bool caustics_prepare(void *state, const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    const bool needed =
        def->caustics && view_shows_clear_fluid(def) && def->drawn_quality != VIEW_DRAFT && def->floor;
    return !needed || caustics_create(state, error);
}

static bool caustics_wanted(const Picture *picture)
{
    const Frame *frame = &picture->frame;
    return picture->particles->count > 0 && frame->def->caustics && frame->fluid.clear > 0 &&
           frame->floor.radius > 0 && !(frame->slab > 0) && frame->def->drawn_quality != VIEW_DRAFT;
}

static void draw_caustics(void *state, Picture *picture)
{
    Frame *frame = &picture->frame;
    frame->floor.light = caustics_draw(state, picture->particles, frame);
}

static const EffectState caustics_state = {
    .size = sizeof(Caustics), .prepare = caustics_prepare, .destroy = caustics_destroy};

const Effect effect_caustics = {.name = "caustics",
                                .stage = STAGE_SHADOW,
                                .state = &caustics_state,
                                .wanted = caustics_wanted,
                                .draw = draw_caustics};

/* ---- glass ---- */

enum { VERTICES = 36 };

typedef struct Glass {
    unsigned program; /* 0: not created yet */
    unsigned vertex_array;
} Glass;

/* Also for a draft, which may end at any time. */
static bool glass_prepare(void *state, const Subject *subject, Error *error)
{
    Glass *glass = state;
    if (!view_has_glass(subject->def) || glass->program)
        return true;
    if (!glass->vertex_array)
        glCreateVertexArrays(1, &glass->vertex_array);
    glass->program = program_create_pair("glass", "render/glass.vert", "render/glass.frag", error);
    return glass->program != 0;
}

static void glass_destroy(void *state)
{
    const Glass *glass = state;
    glDeleteProgram(glass->program);
    glDeleteVertexArrays(1, &glass->vertex_array);
}

static bool glass_wanted(const Picture *picture)
{
    return frame_glass(&picture->frame) == GLASS_PANES;
}

/* Draws the panes that face away from the eye, or towards the eye. Blends colour; tests depth but writes
   none. */
static void glass_draw(const Glass *glass, const Frame *frame, bool behind)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glUseProgram(glass->program);
    glProgramUniform1ui(glass->program, EDGES_BEHIND_AT, behind);
    glBindVertexArray(glass->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, VERTICES);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

static void draw_behind(void *state, Picture *picture)
{
    glass_draw(state, &picture->frame, true);
}

static void draw_before(void *state, Picture *picture)
{
    glass_draw(state, &picture->frame, false);
}

static const EffectState glass_state = {
    .size = sizeof(Glass), .prepare = glass_prepare, .destroy = glass_destroy};

const Effect effect_glass_behind = {.name = "glass_behind",
                                    .stage = STAGE_OVERLAY,
                                    .state = &glass_state,
                                    .wanted = glass_wanted,
                                    .draw = draw_behind};

const Effect effect_glass = {.name = "glass",
                             .stage = STAGE_OVERLAY,
                             .state = &glass_state,
                             .wanted = glass_wanted,
                             .draw = draw_before};
