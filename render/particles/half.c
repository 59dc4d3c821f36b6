#include "render/particles/half.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool particle_half_create(ParticleHalf *half, Error *error)
{
    static const char *const stages[] = {"render/half.comp", NULL};
    half->program = program_create("half", stages, NULL, error);
    return half->program != 0;
}

void particle_half_destroy(ParticleHalf *half)
{
    glDeleteProgram(half->program);
    glDeleteBuffers(1, &half->positions);
    *half = (ParticleHalf){0};
}

void particle_half_run(ParticleHalf *half, const ParticleBuffers *particles, const double normal[3],
                       double most, ParticleBuffers *out)
{
    *out = *particles;
    if (particles->count == 0)
        return;
    if (particles->count > half->capacity) {
        half->capacity = work_capacity(half->capacity, particles->count);
        work_buffer_remake(&half->positions, half->capacity * sizeof(float[4]), "half");
    }
    out->position = (ParticleAttribute){half->positions, 0, sizeof(float[4])};
    glUseProgram(half->program);
    particle_bind(half->program, particles, SCALAR_SPEED); /* no scalar is read */
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, HALF_STORAGE, half->positions);
    glUniform4f(HALF_PLANE_AT, (GLfloat)normal[0], (GLfloat)normal[1], (GLfloat)normal[2], (GLfloat)most);
    glUniform1ui(HALF_COUNT_AT, (GLuint)particles->count);
    work_run(particles->count);
}
