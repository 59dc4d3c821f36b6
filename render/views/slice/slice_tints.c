#include "render/particles/particles.h"
#include "render/views/slice/slice_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/slice/slice_bindings.h"

#include <epoxy/gl.h>

bool slice_tints_shown(const ParticleBuffers *particles, const Frame *frame)
{
    return view_color_by(frame->def) == SCALAR_FLUID && frame->world->fluid_count > 1 &&
           particles->fluid.buffer != 0;
}

static bool make_tints(SliceTints *tints, const ParticleBuffers *particles, Error *error)
{
    static const char *const stages[] = {"slice/slice_tint.comp", NULL};
    if (!tints->program && !(tints->program = program_create("slice tint", stages, NULL, error)))
        return false;
    if (particles->count >
        tints->capacity) { /* whole groups of 64: drivers want arrays at multiples of 256 bytes */
        tints->capacity = (work_capacity(tints->capacity, particles->count) + 63) / 64 * 64;
        work_buffer_remake(&tints->buffer, tints->capacity * 3 * sizeof(float), "slice tints");
    }
    glUseProgram(tints->program);
    particle_bind(tints->program, particles, SCALAR_FLUID);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, tints->buffer);
    glUniform1ui(CURVE_PARTICLES_AT, (GLuint)particles->count);
    glUniform1ui(TINTS_APART_AT, (GLuint)tints->capacity);
    work_run(particles->count);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return true;
}

bool slice_tints_run(SliceTints *tints, PlaneSum *red, const PlaneJob *job, const ParticleBuffers *particles,
                     Error *error)
{
    PlaneSum *const sums[] = {red, &tints->green, &tints->blue};
    ParticleBuffers tinted = *particles;
    ParticleAttribute *const tint = &tinted.scalar[job->scalar];
    if (!make_tints(tints, particles, error))
        return false;
    *tint = (ParticleAttribute){.buffer = tints->buffer, .stride = sizeof(float)};
    for (int k = 0; k < 3; k++, tint->offset += tints->capacity * sizeof(float))
        if (!plane_sum_run(sums[k], job, &tinted, error))
            return false;
    return true;
}

void slice_tints_destroy(SliceTints *tints)
{
    glDeleteProgram(tints->program);
    glDeleteBuffers(1, &tints->buffer);
    plane_sum_destroy(&tints->green);
    plane_sum_destroy(&tints->blue);
}
