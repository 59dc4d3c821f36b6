#include "render/volume/drops.h"

#include "render/frame/view.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool volume_drops_create(VolumeDrops *drops, const ViewDef *def, const char *defines, Error *error)
{
    static const char *const stages[] = {"volume/drops.vert", "volume/drops.frag", NULL};
    quad_indices_create(&drops->quads);
    if (color_table_create(&drops->colors, view_colormap(def), &def->color_curve, error))
        drops->program = program_create("volume drops", stages, defines, error);
    return drops->program != 0;
}

void volume_drops_destroy(VolumeDrops *drops)
{
    glDeleteProgram(drops->program);
    color_table_destroy(&drops->colors);
    quad_indices_destroy(&drops->quads);
    *drops = (VolumeDrops){0};
}

void volume_drops_draw(VolumeDrops *drops, const ParticleBuffers *particles, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    color_table_bind(&drops->colors, &frame->def->color_curve);
    glUseProgram(drops->program);
    particle_bind(drops->program, particles, view_color_by(frame->def));
    glUniform1i(DROPS_FLAT_AT, frame->slab > 0);
    quad_indices_draw(&drops->quads, particles->count);
    glDisable(GL_DEPTH_TEST);
}
