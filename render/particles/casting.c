#include "render/particles/casting.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool casting_create(Casting *casting, const char *defines, Error *error)
{
    static const char *const stages[] = {"render/ball_shadow.comp", NULL};
    *casting = (Casting){0};
    glCreateVertexArrays(1, &casting->screen);
    work_buffer_remake(&casting->texels, sizeof(GLuint) * SHADOW_MAP_TEXELS * SHADOW_MAP_TEXELS, "cast");
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &casting->rows);
    glTextureBuffer(casting->rows, GL_RGBA32UI, casting->texels);
    casting->write = program_create("cast", stages, defines, error);
    if (casting->write)
        casting->show = program_create_pair("cast map", "common/screen.vert", "render/cast.frag", error);
    return casting->show != 0;
}

void casting_destroy(Casting *casting)
{
    glDeleteProgram(casting->write);
    glDeleteProgram(casting->show);
    glDeleteTextures(1, &casting->rows);
    glDeleteBuffers(1, &casting->texels);
    glDeleteVertexArrays(1, &casting->screen);
    *casting = (Casting){0};
}

void casting_draw(const Casting *casting, const ParticleBuffers *particles)
{
    if (particles->count == 0)
        return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
    glClearNamedBufferData(casting->texels, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CAST_STORAGE, casting->texels);
    glBindTextureUnit(CAST_UNIT, casting->rows);
    glUseProgram(casting->write);
    particle_bind(casting->write, particles, SCALAR_SPEED); /* no scalar is read */
    glUniform1ui(CASTERS_AT, (GLuint)particles->count);
    work_run_scattered(particles->count);
    glUseProgram(casting->show);
    glBindVertexArray(casting->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}
