#include "render/splat/thickness.h"

#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

/* Texels that the support radius has at least, of a particle far away. */
static const float TEXELS = 2;
static const unsigned COARSEST = 8;

bool thickness_create(Thickness *thickness, const SplatSprites *sprites, bool solids, Error *error)
{
    const char *const solid = solids ? "#define SOLIDS 1\n" : NULL;
    const char *defines = solids ? "#define THICKNESS 1\n#define SOLIDS 1\n" : "#define THICKNESS 1\n";
    *thickness = (Thickness){0};
    static const char *const filled[] = {"common/screen.vert", "splat/clear/filled.frag", NULL};
    thickness->filled = program_create("splat filled", filled, solid, error);
    if (!thickness->filled)
        return false;
    glCreateVertexArrays(1, &thickness->screen);
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        if (!splat_sprites_may(sprites, (SplatSprite)sprite))
            continue;
        thickness->program[sprite] = splat_sprites_program(sprites, (SplatSprite)sprite, false,
                                                           "splat/clear/thickness.frag", defines, error);
        if (!thickness->program[sprite])
            return false;
    }
    return true;
}

static void delete_map(Thickness *thickness)
{
    glDeleteTextures(1, &thickness->map);
    glDeleteFramebuffers(1, &thickness->framebuffer);
    thickness->map = thickness->framebuffer = thickness->target_number = 0;
}

void thickness_destroy(Thickness *thickness)
{
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++)
        glDeleteProgram(thickness->program[sprite]);
    glDeleteProgram(thickness->filled);
    glDeleteVertexArrays(1, &thickness->screen);
    delete_map(thickness);
}

static unsigned texels(int pixels, unsigned cell)
{
    return ((unsigned)pixels + cell - 1) / cell;
}

static void follow(Thickness *thickness, const Target *target, unsigned cell)
{
    if (thickness->target_number == target->number && thickness->cell == cell)
        return;
    delete_map(thickness);
    glCreateTextures(GL_TEXTURE_2D, 1, &thickness->map);
    glObjectLabel(GL_TEXTURE, thickness->map, -1, "thickness");
    glTextureStorage2D(thickness->map, 1, GL_RG32F, (GLsizei)texels(target->width, cell),
                       (GLsizei)texels(target->height, cell));
    glTextureParameteri(thickness->map, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(thickness->map, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(thickness->map, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(thickness->map, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, &thickness->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, thickness->framebuffer, -1, "thickness");
    glNamedFramebufferTexture(thickness->framebuffer, GL_COLOR_ATTACHMENT0, thickness->map, 0);
    thickness->target_number = target->number;
    thickness->cell = cell;
}

static void fill_box(const Thickness *thickness, float support, int width, int height, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, thickness->framebuffer);
    glViewport(0, 0, width, height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glUseProgram(thickness->filled);
    glUniform1f(SPLAT_RADIUS_AT, support);
    glUniform2f(MAP_SIZE_AT, (float)width, (float)height);
    if (frame->world->solid_count > 0)
        glBindTextureUnit(TARGET_DEPTH_UNIT, frame->target->depth);
    glBindVertexArray(thickness->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static float pixel_at(const Frame *frame, float depth)
{
    return 2 * depth * frame->camera.tangent[1] / (float)frame->height;
}

void thickness_draw(Thickness *thickness, SplatSprites *sprites, const ParticleBuffers *particles,
                    const Frame *frame)
{
    const float far_pixel = pixel_at(frame, fmaxf(frame->farthest, frame->camera.near_plane));
    /* Where the support radius is not even a pixel, a wider kernel keeps the sum right on the whole. */
    const float support = fmaxf((float)particles->support_radius, 1.5F * far_pixel);
    const float fitting = support / (TEXELS * far_pixel);
    const unsigned cell = (unsigned)fmaxf(1, fminf(floorf(fitting), (float)COARSEST));
    follow(thickness, frame->target, cell);
    const int width = (int)texels(frame->width, cell), height = (int)texels(frame->height, cell);
    const SplatSprite sprite =
        splat_sprites_choose(sprites, frame, support, (float)frame->height / (float)cell);
    fill_box(thickness, support, width, height, frame);
    splat_sprites_begin(thickness->framebuffer, frame, GL_FUNC_ADD);
    glViewport(0, 0, width, height);
    glProgramUniform1f(thickness->program[sprite], SPLAT_RADIUS_AT, support);
    glProgramUniform2f(thickness->program[sprite], MAP_SIZE_AT, (float)width, (float)height);
    if (frame->world->solid_count > 0)
        glBindTextureUnit(TARGET_DEPTH_UNIT, frame->target->depth);
    splat_sprites_draw(sprites, sprite, thickness->program[sprite], particles, frame, NULL);
    glDisable(GL_BLEND);
}
