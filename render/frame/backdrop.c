#include "render/frame/backdrop.h"

#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <string.h>

bool backdrop_create(Backdrop *backdrop, Error *error)
{
    static const char *const stages[] = {"render/backdrop.vert", "render/backdrop.frag", NULL};
    *backdrop = (Backdrop){0};
    glCreateVertexArrays(1, &backdrop->vertex_array);
    backdrop->program = program_create("backdrop", stages, NULL, error);
    if (backdrop->program)
        backdrop->shadow_program = program_create("shaded floor", stages, "#define FLOOR_SHADOW 1\n", error);
    return backdrop->shadow_program != 0;
}

static void forget(Backdrop *backdrop)
{
    glDeleteFramebuffers(1, &backdrop->kept_framebuffer);
    glDeleteTextures(1, &backdrop->kept_color);
    backdrop->kept_framebuffer = backdrop->kept_color = backdrop->kept_target = 0;
    backdrop->kept = false;
}

void backdrop_destroy(Backdrop *backdrop)
{
    forget(backdrop);
    glDeleteProgram(backdrop->program);
    glDeleteProgram(backdrop->shadow_program);
    glDeleteVertexArrays(1, &backdrop->vertex_array);
    *backdrop = (Backdrop){0};
}

static double *append(double *to, const float *from, int count)
{
    for (int i = 0; i < count; i++)
        *to++ = from[i];
    return to;
}

static void make_key(const Frame *frame, double key[BACKDROP_KEY_SIZE])
{
    const Camera *camera = &frame->camera;
    key = append(key, camera->eye, 3);
    key = append(key, camera->view, 16);
    key = append(key, camera->tangent, 2);
    key = append(key, camera->centre, 2);
    key = append(key, &camera->near_plane, 1);
    key = append(key, &frame->floor_height, 1);
    key = append(key, frame->floor_center, 2);
    key = append(key, &frame->floor_radius, 1);
    for (int i = 0; i < 3; i++)
        *key++ = frame->def->background[i];
    *key = frame->target->number;
}

/* True if the backdrop equals the backdrop of the last picture. */
static bool stands_still(Backdrop *backdrop, const Frame *frame)
{
    double key[BACKDROP_KEY_SIZE];
    bool same = true;
    make_key(frame, key);
    for (int i = 0; i < BACKDROP_KEY_SIZE; i++)
        same = same && key[i] == backdrop->seen[i];
    memcpy(backdrop->seen, key, sizeof key);
    return same;
}

static void draw_unshaded(const Backdrop *backdrop, const Frame *frame, GLuint framebuffer)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glUseProgram(backdrop->program);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void keep(Backdrop *backdrop, const Frame *frame)
{
    if (backdrop->kept_target != frame->target->number) {
        forget(backdrop);
        glCreateTextures(GL_TEXTURE_2D, 1, &backdrop->kept_color);
        glTextureStorage2D(backdrop->kept_color, 1, GL_SRGB8_ALPHA8, frame->width, frame->height);
        glObjectLabel(GL_TEXTURE, backdrop->kept_color, -1, "kept backdrop");
        glCreateFramebuffers(1, &backdrop->kept_framebuffer);
        glNamedFramebufferTexture(backdrop->kept_framebuffer, GL_COLOR_ATTACHMENT0, backdrop->kept_color, 0);
        glObjectLabel(GL_FRAMEBUFFER, backdrop->kept_framebuffer, -1, "kept backdrop");
        backdrop->kept_target = frame->target->number;
    }
    draw_unshaded(backdrop, frame, backdrop->kept_framebuffer);
    backdrop->kept = true;
}

/* The backdrop is kept from the second picture of a still camera on; a moving camera pays nothing. */
static void lay(Backdrop *backdrop, const Frame *frame)
{
    if (!stands_still(backdrop, frame)) {
        backdrop->kept = false;
        draw_unshaded(backdrop, frame, frame->target->framebuffer);
        return;
    }
    if (!backdrop->kept)
        keep(backdrop, frame);
    glCopyImageSubData(backdrop->kept_color, GL_TEXTURE_2D, 0, 0, 0, 0, frame->target->color, GL_TEXTURE_2D,
                       0, 0, 0, 0, frame->width, frame->height, 1);
}

static void shade_floor(const Backdrop *backdrop, const Frame *frame)
{
    if (frame->floor_radius <= 0 || frame->camera.eye[1] <= frame->floor_height)
        return;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor_light);
    glUseProgram(backdrop->shadow_program);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void backdrop_draw(Backdrop *backdrop, const Frame *frame)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glBindVertexArray(backdrop->vertex_array);
    lay(backdrop, frame);
    shade_floor(backdrop, frame);
}
