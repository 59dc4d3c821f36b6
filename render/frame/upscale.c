#include "render/frame/effect.h"
#include "shaders/shared/bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

static int part_of(int pixels, double resolution)
{
    return (int)fmax(round(resolution * pixels), 1);
}

static GLuint create_encoded(const Target *target)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glTextureView(texture, GL_TEXTURE_2D, target->color, GL_RGBA8, 0, 1, 0, 1);
    glObjectLabel(GL_TEXTURE, texture, -1, "coarse picture");
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static bool create(Upscale *coarse, int width, int height, Error *error)
{
    static const char *const lines[] = {"render/edges.vert", "render/edges.frag", NULL};
    if (!target_create(&coarse->target, width, height, error))
        return false;
    coarse->encoded = create_encoded(&coarse->target);
    glCreateVertexArrays(1, &coarse->vertices);
    coarse->program = program_create_pair("enlarge", "render/enlarge.vert", "render/enlarge.frag", error);
    if (coarse->program)
        coarse->edges = program_create("edges, enlarged", lines, "#define COARSE 1\n", error);
    return coarse->edges != 0;
}

bool upscale_update(Upscale *coarse, double resolution, int width, int height, Error *error)
{
    const int across = part_of(width, resolution), down = part_of(height, resolution);
    const bool wanted = resolution < 1;
    Upscale made = {.program = 0};
    if (wanted && coarse->target.width == across && coarse->target.height == down)
        return true;
    if (wanted && !create(&made, across, down, error)) {
        upscale_destroy(&made);
        return false;
    }
    upscale_destroy(coarse);
    *coarse = made;
    return true;
}

void upscale_destroy(Upscale *coarse)
{
    if (coarse->target.framebuffer)
        target_destroy(&coarse->target);
    glDeleteTextures(1, &coarse->encoded);
    glDeleteProgram(coarse->program);
    glDeleteProgram(coarse->edges);
    glDeleteVertexArrays(1, &coarse->vertices);
    *coarse = (Upscale){.program = 0};
}

/* Interpolates encoded colours linearly: linear light would cost a software driver twice the time. Leaves
   sRGB encoding off. */
static void enlarge(const Upscale *coarse, int width, int height)
{
    glViewport(0, 0, width, height);
    glDisable(GL_FRAMEBUFFER_SRGB); /* colours are encoded already */
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glBindTextureUnit(ENLARGED_UNIT, coarse->encoded);
    glUseProgram(coarse->program);
    glBindVertexArray(coarse->vertices);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void draw_enlarged(void *state, Picture *picture)
{
    (void)state;
    glBindFramebuffer(GL_FRAMEBUFFER, picture->framebuffer);
    if (picture->coarse)
        enlarge(picture->coarse, picture->frame.width, picture->frame.height);
}

const Effect effect_enlarge = {.name = "enlarge", .stage = STAGE_OVERLAY, .draw = draw_enlarged};

void upscale_depth(const Upscale *coarse, const Target *to)
{
    const Target *from = &coarse->target;
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(from->framebuffer, to->framebuffer, 0, 0, from->width, from->height, 0, 0,
                           to->width, to->height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}
