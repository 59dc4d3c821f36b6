#include "render/frame/passes.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "sim/gpu/program.h"

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

static void forget_kept(Backdrop *backdrop)
{
    glDeleteFramebuffers(1, &backdrop->kept_framebuffer);
    glDeleteTextures(1, &backdrop->kept_color);
    backdrop->kept_framebuffer = backdrop->kept_color = backdrop->kept_target = 0;
    backdrop->kept = false;
}

void backdrop_destroy(Backdrop *backdrop)
{
    forget_kept(backdrop);
    glDeleteProgram(backdrop->program);
    glDeleteProgram(backdrop->shadow_program);
    glDeleteVertexArrays(1, &backdrop->vertex_array);
    *backdrop = (Backdrop){0};
}

static double *append_numbers(double *to, const float *from, int count)
{
    for (int i = 0; i < count; i++)
        *to++ = from[i];
    return to;
}

static void make_key(const Frame *frame, double key[BACKDROP_KEY_SIZE])
{
    const Camera *camera = &frame->camera;
    key = append_numbers(key, camera->eye, 3);
    key = append_numbers(key, camera->view, 16);
    key = append_numbers(key, camera->tangent, 2);
    key = append_numbers(key, camera->centre, 2);
    key = append_numbers(key, &camera->near_plane, 1);
    key = append_numbers(key, &frame->floor_height, 1);
    key = append_numbers(key, frame->floor_center, 2);
    key = append_numbers(key, &frame->floor_radius, 1);
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
        forget_kept(backdrop);
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
static void copy_kept(Backdrop *backdrop, const Frame *frame)
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
    copy_kept(backdrop, frame);
    shade_floor(backdrop, frame);
}

/* Both maps extend beyond all shadows, so the border texels are right for everything outside. */
static GLuint create_map(GLenum format, GLint filter, int texels, const char *label)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glObjectLabel(GL_TEXTURE, map, -1, label);
    glTextureStorage2D(map, 1, format, texels, texels);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(map, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(map, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return map;
}

/* Compared on reading. Outside the map nothing casts a shadow: solids may leave the box. */
static GLuint create_solid_map(void)
{
    GLuint map = create_map(GL_DEPTH_COMPONENT32F, GL_LINEAR, SHADOW_MAP_TEXELS, "solid shadow map");
    glTextureParameteri(map, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTextureParameteri(map, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTextureParameteri(map, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(map, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    return map;
}

static GLuint create_framebuffer(GLenum attachment, GLuint map, const char *label)
{
    GLuint framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, label);
    glNamedFramebufferTexture(framebuffer, attachment, map, 0);
    if (attachment == GL_DEPTH_ATTACHMENT)
        glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
    return framebuffer;
}

static GLuint create_floor_program(const char *label, const char *defines, Error *error)
{
    static const char *const stages[] = {"common/screen.vert", "render/floor_shadow.frag", NULL};
    return program_create(label, stages, defines, error);
}

bool shadow_create(Shadow *shadow, Error *error)
{
    *shadow = (Shadow){0};
    shadow->map = create_map(GL_DEPTH_COMPONENT32F, GL_NEAREST, SHADOW_MAP_TEXELS, "shadow map");
    shadow->framebuffer = create_framebuffer(GL_DEPTH_ATTACHMENT, shadow->map, "shadow");
    shadow->floor_map = create_map(GL_R32F, GL_LINEAR, FLOOR_MAP_TEXELS, "floor shadow map");
    shadow->floor_framebuffer = create_framebuffer(GL_COLOR_ATTACHMENT0, shadow->floor_map, "floor shadow");
    glCreateVertexArrays(1, &shadow->vertex_array);
    shadow->floor_program = create_floor_program("floor shadow", NULL, error);
    if (!shadow->floor_program)
        shadow_destroy(shadow);
    return shadow->floor_program != 0;
}

static void drop_solids(Shadow *shadow)
{
    glDeleteFramebuffers(1, &shadow->solid_framebuffer);
    glDeleteTextures(1, &shadow->solid_map);
    glDeleteProgram(shadow->solid_floor_program);
    shadow->solid_framebuffer = shadow->solid_map = shadow->solid_floor_program = 0;
}

bool shadow_update_solids(Shadow *shadow, bool solids, Error *error)
{
    if (solids == (shadow->solid_map != 0))
        return true;
    if (!solids) {
        drop_solids(shadow);
        return true;
    }
    shadow->solid_floor_program = create_floor_program("floor shadow, solids", "#define SOLIDS 1\n", error);
    if (!shadow->solid_floor_program)
        return false;
    shadow->solid_map = create_solid_map();
    shadow->solid_framebuffer = create_framebuffer(GL_DEPTH_ATTACHMENT, shadow->solid_map, "solid shadow");
    return true;
}

void shadow_destroy(Shadow *shadow)
{
    drop_solids(shadow);
    glDeleteFramebuffers(1, &shadow->framebuffer);
    glDeleteFramebuffers(1, &shadow->floor_framebuffer);
    glDeleteTextures(1, &shadow->map);
    glDeleteTextures(1, &shadow->floor_map);
    glDeleteVertexArrays(1, &shadow->vertex_array);
    glDeleteProgram(shadow->floor_program);
    *shadow = (Shadow){0};
}

static void begin_map(GLuint framebuffer)
{
    static const float nothing = 0;
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, SHADOW_MAP_TEXELS, SHADOW_MAP_TEXELS);
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &nothing);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
}

void shadow_begin(const Shadow *shadow)
{
    begin_map(shadow->framebuffer);
}

void shadow_begin_solids(const Shadow *shadow)
{
    begin_map(shadow->solid_framebuffer);
}

void shadow_end(const Shadow *shadow, const Frame *frame)
{
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(SHADOW_UNIT, shadow->map);
    if (shadow->solid_map)
        glBindTextureUnit(SOLID_SHADOW_UNIT, shadow->solid_map);
    if (frame->floor_radius <= 0)
        return;
    glBindFramebuffer(GL_FRAMEBUFFER, shadow->floor_framebuffer);
    glViewport(0, 0, FLOOR_MAP_TEXELS, FLOOR_MAP_TEXELS);
    glUseProgram(shadow->solid_map ? shadow->solid_floor_program : shadow->floor_program);
    glUniform1f(CLEAR_AT, frame->clear);
    glBindVertexArray(shadow->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}
