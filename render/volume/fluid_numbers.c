#include "render/volume/fluid_numbers.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "render/volume/voxelize.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool fluid_numbers_create(FluidNumbers *numbers, Error *error)
{
    *numbers = (FluidNumbers){
        .program = program_create("fluid numbers", (const char *const[]){"volume/fluid_numbers.comp", NULL},
                                  NULL, error)};
    return numbers->program != 0;
}

void fluid_numbers_destroy(FluidNumbers *numbers)
{
    glDeleteProgram(numbers->program);
    glDeleteBuffers(1, &numbers->buffer);
    *numbers = (FluidNumbers){0};
}

static void reserve(FluidNumbers *numbers, size_t count)
{
    if (count <= numbers->capacity)
        return;
    numbers->capacity = work_capacity(numbers->capacity, count);
    work_buffer_remake(&numbers->buffer, numbers->capacity * sizeof(GLfloat), "fluid numbers");
}

ParticleBuffers fluid_numbers_add(FluidNumbers *numbers, const ParticleBuffers *particles)
{
    ParticleBuffers with = *particles;
    if (!particles->fluid.buffer || !particles->count)
        return with;
    reserve(numbers, particles->count);
    glUseProgram(numbers->program);
    particle_bind(numbers->program, particles, SCALAR_FLUID);
    glUniform1ui(FLUID_COUNT_AT, (GLuint)particles->count);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FLUID_NUMBERS_STORAGE, numbers->buffer);
    work_run(particles->count);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    with.scalar[SCALAR_FLUID] = (ParticleAttribute){numbers->buffer, 0, sizeof(GLfloat)};
    return with;
}
