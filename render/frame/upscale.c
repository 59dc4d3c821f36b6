#include "render/frame/effect.h"
#include "shaders/shared/bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

/* Pixels that are drawn at most for one that is shown several times: a picture of 4096 x 4096. */
static const double PIXELS_MOST = 1 << 24;

static int part_of(int pixels, double resolution)
{
    return (int)fmax(round(resolution * pixels), 1);
}

/* The resolution that memory and driver allow: large pictures have fewer samples of a pixel. */
static double resolution_within(double wanted, int width, int height)
{
    GLint limit = 0;
    if (wanted <= 1)
        return wanted;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    const double by_memory = sqrt(PIXELS_MOST / width / height),
                 by_driver = (double)limit / (width > height ? width : height);
    return fmax(1, fmin(wanted, fmin(by_memory, by_driver)));
}

/* `fine`: more pixels than shown, averaged in linear light. Fewer pixels are enlarged by their encoded
   bytes. */
static GLuint create_shown(const Target *target, bool fine)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glTextureView(texture, GL_TEXTURE_2D, target->color, fine ? GL_SRGB8_ALPHA8 : GL_RGBA8, 0, 1, 0, 1);
    glObjectLabel(GL_TEXTURE, texture, -1, "picture of another resolution");
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static bool create(Upscale *coarse, int width, int height, bool fine, Error *error)
{
    static const char *const lines[] = {"render/edges.vert", "render/edges.frag", NULL};
    static const char *const picture[] = {"render/enlarge.vert", "render/enlarge.frag", NULL};
    if (!target_create(&coarse->target, width, height, error))
        return false;
    coarse->shown = create_shown(&coarse->target, fine);
    glCreateVertexArrays(1, &coarse->vertices);
    coarse->program = fine ? program_create("reduce", picture, "#define FINE 1\n", error)
                           : program_create("enlarge", picture, NULL, error);
    if (coarse->program)
        coarse->edges = program_create("edges, enlarged", lines, "#define COARSE 1\n", error);
    return coarse->edges != 0;
}

bool upscale_update(Upscale *coarse, double resolution, int width, int height, Error *error)
{
    const double drawn = resolution_within(resolution, width, height);
    const int across = part_of(width, drawn), down = part_of(height, drawn);
    const bool wanted = drawn != 1, fine = drawn > 1;
    Upscale made = {.program = 0};
    if (wanted && coarse->target.width == across && coarse->target.height == down && coarse->fine == fine)
        return true;
    if (wanted && !create(&made, across, down, fine, error)) {
        upscale_destroy(&made);
        return false;
    }
    made.fine = fine;
    upscale_destroy(coarse);
    *coarse = made;
    return true;
}

void upscale_destroy(Upscale *coarse)
{
    if (coarse->target.framebuffer)
        target_destroy(&coarse->target);
    glDeleteTextures(1, &coarse->shown);
    glDeleteProgram(coarse->program);
    glDeleteProgram(coarse->edges);
    glDeleteVertexArrays(1, &coarse->vertices);
    *coarse = (Upscale){.program = 0};
}

/* Enlarges encoded colours: linear light would cost a software driver twice the time. Of more pixels than
   shown, each shown pixel is the mean of those inside. Leaves sRGB encoding off. */
static void enlarge(const Upscale *coarse, int width, int height)
{
    glViewport(0, 0, width, height);
    glDisable(GL_FRAMEBUFFER_SRGB); /* colours are encoded already */
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glBindTextureUnit(ENLARGED_UNIT, coarse->shown);
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
