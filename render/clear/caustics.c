#include "render/clear/caustics.h"

#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

enum { FIND, SMOOTH, GATHER, COMPOSE };

static const double SMOOTHED = 6; /* half the width in spacings; three standard deviations of the weights */

static void create_map(Caustics *caustics, int map, GLenum format, const char *label)
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
    static const char *const files[4][2] = {{"common/screen.vert", "clear/caustics_height.frag"},
                                            {"common/screen.vert", "clear/caustics_smooth.frag"},
                                            {"clear/caustics.vert", "clear/caustics.frag"},
                                            {"common/screen.vert", "clear/caustics_light.frag"}};
    if (caustics->vertex_array)
        return caustics->programs[COMPOSE] != 0;
    glCreateVertexArrays(1, &caustics->vertex_array);
    create_map(caustics, CAUSTIC_HEIGHT, GL_RGBA32F, "caustics, height");
    create_map(caustics, CAUSTIC_SMOOTH, GL_RGBA32F, "caustics, smooth height");
    create_map(caustics, CAUSTIC_FACTOR, GL_R32F, "caustics");
    create_map(caustics, CAUSTIC_LIGHT, GL_R32F, "floor light");
    for (int i = 0; i < 4; i++)
        if (!(caustics->programs[i] = program_create_pair("caustics", files[i][0], files[i][1], error)))
            return false;
    return true;
}

void caustics_destroy(Caustics *caustics)
{
    for (int i = 0; i < 4; i++)
        glDeleteProgram(caustics->programs[i]);
    glDeleteVertexArrays(1, &caustics->vertex_array);
    glDeleteTextures(CAUSTIC_MAPS, caustics->maps);
    glDeleteFramebuffers(CAUSTIC_MAPS, caustics->framebuffers);
    *caustics = (Caustics){0};
}

bool caustics_wanted(const Frame *frame)
{
    return frame->def->caustics && frame->clear > 0 && frame->floor_radius > 0 && !(frame->slab > 0) &&
           frame->def->drawn_quality != VIEW_DRAFT;
}

static void pass(const Caustics *caustics, int program, unsigned from, int to)
{
    glBindFramebuffer(GL_FRAMEBUFFER, caustics->framebuffers[to]);
    glBindTextureUnit(CAUSTIC_UNIT, from);
    glUseProgram(caustics->programs[program]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void smooth(const Caustics *caustics, const Frame *frame, double spacing)
{
    const GLuint program = caustics->programs[SMOOTH];
    for (int k = 0; k < 2; k++) {
        const double reach = SMOOTHED * spacing * CAUSTIC_TEXELS / frame->floor_map_size[k];
        glProgramUniform2i(program, CAUSTIC_STEP_AT, k == 0, k == 1);
        glProgramUniform1f(program, CAUSTIC_WIDTH_AT, (float)fmax(reach, 1));
        pass(caustics, SMOOTH, caustics->maps[k == 0 ? CAUSTIC_HEIGHT : CAUSTIC_SMOOTH],
             k == 0 ? CAUSTIC_SMOOTH : CAUSTIC_HEIGHT);
    }
}

/* Twice the height above the floor that the fluid would have at rest, m. */
static double highest(const Frame *frame, const ParticleBuffers *particles)
{
    const double *box = particles->box_size, side = particles->spacing;
    const double bottom = particles->box.position[1] - frame->floor_height;
    return fmax(bottom, 0) + 2 * (double)particles->count * side * side * side / (box[0] * box[2]);
}

/* Adds up the light of all points. */
static void gather(const Caustics *caustics, const Frame *frame, const ParticleBuffers *particles)
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
    glProgramUniform1f(program, REFRACTION_INDEX_AT, frame->refraction);
    glProgramUniform1f(program, CAUSTIC_HIGHEST_AT, (float)highest(frame, particles));
    glDrawArrays(GL_POINTS, 0, CAUSTIC_TEXELS * CAUSTIC_TEXELS);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame,
                       unsigned shadow_left)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, CAUSTIC_TEXELS, CAUSTIC_TEXELS);
    glBindVertexArray(caustics->vertex_array);
    pass(caustics, FIND, 0, CAUSTIC_HEIGHT);
    smooth(caustics, frame, particles->spacing);
    gather(caustics, frame, particles);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, shadow_left);
    pass(caustics, COMPOSE, caustics->maps[CAUSTIC_FACTOR], CAUSTIC_LIGHT);
    return caustics->maps[CAUSTIC_LIGHT];
}
