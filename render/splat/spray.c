#include "render/splat/spray.h"

#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <stdio.h>

bool spray_create(Spray *spray, const SplatSprites *sprites, const Subject *subject, Error *error)
{
    char defines[96];
    *spray = (Spray){0};
    snprintf(defines, sizeof defines, "#define BLEND 1\n#define ALONE 1\n#define SHADING %d\n%s",
             (int)sprites->def.shading, subject->world->solid_count > 0 ? "#define SOLIDS 1\n" : "");
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        if (!splat_sprites_may(sprites, (SplatSprite)sprite))
            continue;
        spray->program[sprite] = splat_sprites_program(sprites, (SplatSprite)sprite, true,
                                                       "splat/clear/spray.frag", defines, error);
        if (!spray->program[sprite])
            return false;
    }
    static const char *const list[] = {"splat/clear/spray_list.comp", NULL};
    work_buffer_remake(&spray->command, 8 * sizeof(GLuint), "spray command");
    spray->find = program_create("spray list", list, NULL, error);
    return spray->find != 0;
}

void spray_destroy(Spray *spray)
{
    glDeleteProgram(spray->find);
    glDeleteBuffers(2, (GLuint[]){spray->list, spray->command});
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++)
        glDeleteProgram(spray->program[sprite]);
}

void spray_find(Spray *spray, SplatSprite sprite, const ParticleBuffers *particles)
{
    if (particles->count > spray->capacity) {
        spray->capacity = work_capacity(spray->capacity, particles->count);
        work_buffer_remake(&spray->list, spray->capacity * sizeof(GLuint), "spray list");
    }
    if (particles->count == 0)
        return;
    glUseProgram(spray->find);
    glUniform1ui(CULL_COUNT_AT, (GLuint)particles->count);
    glUniform1ui(VERTICES_AT, sprite == SPLAT_POINT ? 1 : 6);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NEAREST_LIST_STORAGE, spray->list);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_COMMANDS_STORAGE, spray->command);
    work_run(1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

void spray_draw(const Spray *spray, SprayPart part, unsigned nearest, Behind *behind, const Edges *edges,
                SplatSprites *sprites, SplatSprite sprite, const ParticleBuffers *particles,
                const Frame *frame)
{
    const SplatDef *def = splat_def(frame->def);
    const GLuint program = spray->program[sprite];
    behind_take(behind, edges, frame);
    glProgramUniform1f(program, REFRACTION_INDEX_AT, (float)def->ior);
    glProgramUniform1f(program, ATTENUATION_AT,
                       def->attenuation > 0 ? (float)def->attenuation : frame->attenuation);
    glProgramUniform1ui(program, SPRAY_BEHIND_AT, part == SPRAY_BEHIND);
    glBindTextureUnit(NEAREST_UNIT, nearest);
    splat_sprites_begin(frame->target->framebuffer, frame, GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(part == SPRAY_BEFORE);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LISTED_STORAGE, spray->list);
    splat_sprites_draw_listed(sprites, sprite, program, particles, frame, spray->command);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}
