#include "render/splat/thickness.h"

#include "render/splat/splat_maps.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

/* Least number of texels per support radius, for the farthest particle. */
static const float TEXELS = 2;
static const unsigned COARSEST = 8;

bool thickness_create(Thickness *thickness, const SplatSprites *sprites, bool solids, Error *error)
{
    const char *const solid = solids ? "#define SOLIDS 1\n" : NULL;
    const char *defines = solids ? "#define THICKNESS 1\n#define SOLIDS 1\n" : "#define THICKNESS 1\n";
    *thickness = (Thickness){0};
    static const char *const fill[] = {"common/screen.vert", "splat/clear/filled.frag", NULL};
    thickness->fill = program_create("splat filled", fill, solid, error);
    if (!thickness->fill)
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

static void delete_maps(Thickness *thickness)
{
    glDeleteTextures(2, (GLuint[]){thickness->map, thickness->filled});
    glDeleteFramebuffers(2, (GLuint[]){thickness->framebuffer, thickness->filled_framebuffer});
    thickness->map = thickness->filled = thickness->target_number = 0;
    thickness->framebuffer = thickness->filled_framebuffer = 0;
}

void thickness_destroy(Thickness *thickness)
{
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++)
        glDeleteProgram(thickness->program[sprite]);
    glDeleteProgram(thickness->fill);
    glDeleteVertexArrays(1, &thickness->screen);
    delete_maps(thickness);
}

static unsigned texels(int pixels, unsigned cell)
{
    return ((unsigned)pixels + cell - 1) / cell;
}

static GLuint create_map(int width, int height, const char *label)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glObjectLabel(GL_TEXTURE, map, -1, label);
    glTextureStorage2D(map, 1, GL_R32F, width, height);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(map, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return map;
}

static void follow(Thickness *thickness, const Target *target, unsigned cell)
{
    if (thickness->target_number == target->number && thickness->cell == cell)
        return;
    delete_maps(thickness);
    const int width = (int)texels(target->width, cell), height = (int)texels(target->height, cell);
    thickness->map = create_map(width, height, "thickness");
    thickness->filled = create_map(width, height, "thickness of a full box");
    thickness->framebuffer = splat_framebuffer_create(&thickness->map, 1, "thickness");
    thickness->filled_framebuffer =
        splat_framebuffer_create(&thickness->filled, 1, "thickness of a full box");
    thickness->target_number = target->number;
    thickness->cell = cell;
}

/* Fills only the particles' bounds and a support radius around: other texels are never read. */
static void fill_box(const Thickness *thickness, float support, int width, int height, const Frame *frame)
{
    int part[4];
    frame_bounds(frame, part);
    glBindFramebuffer(GL_FRAMEBUFFER, thickness->filled_framebuffer);
    glViewport(0, 0, width, height);
    glEnable(GL_SCISSOR_TEST);
    const int cell = (int)thickness->cell, x = part[0] / cell - 1, y = part[1] / cell - 1;
    glScissor(x, y, part[2] / cell + 2 - x, part[3] / cell + 2 - y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glUseProgram(thickness->fill);
    glUniform1f(SPLAT_RADIUS_AT, support);
    glUniform2f(MAP_SIZE_AT, (float)width, (float)height);
    if (frame->world->solid_count > 0)
        glBindTextureUnit(TARGET_DEPTH_UNIT, frame->target->depth);
    glBindVertexArray(thickness->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

static float pixel_at(const Frame *frame, float depth)
{
    return 2 * depth * frame->camera.tangent[1] / (float)frame->height;
}

void thickness_draw(Thickness *thickness, SplatSprites *sprites, const ParticleBuffers *particles,
                    const Frame *frame)
{
    const float far_pixel = pixel_at(frame, fmaxf(frame->farthest, frame->camera.near_plane));
    /* If the support radius is below a pixel, a wider kernel keeps the total right. */
    const float support = fmaxf((float)particles->support_radius, 1.5F * far_pixel);
    const float fitting = support / (TEXELS * far_pixel);
    const unsigned cell = (unsigned)fmaxf(1, fminf(floorf(fitting), (float)COARSEST));
    follow(thickness, frame->target, cell);
    const int width = (int)texels(frame->width, cell), height = (int)texels(frame->height, cell);
    const SplatSprite sprite =
        splat_sprites_choose(sprites, frame, support, (float)frame->height / (float)cell);
    fill_box(thickness, support, width, height, frame);
    glClearNamedFramebufferfv(thickness->framebuffer, GL_COLOR, 0, (GLfloat[4]){0});
    splat_sprites_begin(thickness->framebuffer, frame, GL_FUNC_ADD);
    glViewport(0, 0, width, height);
    glProgramUniform1f(thickness->program[sprite], SPLAT_RADIUS_AT, support);
    glProgramUniform2f(thickness->program[sprite], MAP_SIZE_AT, (float)width, (float)height);
    if (frame->world->solid_count > 0)
        glBindTextureUnit(TARGET_DEPTH_UNIT, frame->target->depth);
    splat_sprites_draw(sprites, sprite, thickness->program[sprite], particles, frame, NULL);
    glDisable(GL_BLEND);
}
