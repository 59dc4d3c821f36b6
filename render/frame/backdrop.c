/* The light on the floor, and the backdrop: sky and floor. */
#include "render/frame/effect.h"
#include "render/frame/view.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <string.h>

/* The first pass that writes the target: its colour; no depth. The floor is lit by Frame.floor.light.

   Without the fluid's shadow the backdrop depends on the camera alone and is kept while the camera stands
   still. Then a picture costs a copy, and shading of the floor where the light is not full. */

enum { BACKDROP_KEY_SIZE = 32 };

typedef struct Backdrop {
    unsigned program, shadow_program, vertex_array;
    double seen[BACKDROP_KEY_SIZE]; /* all inputs of sky and lit floor in the last picture */
    bool cached;                    /* `cached_color` holds the backdrop of `seen` */
    unsigned cached_framebuffer, cached_color;
    unsigned cached_target; /* number of the target that gave both objects their size; 0: not created yet */
} Backdrop;

static bool backdrop_prepare(void *state, const Subject *subject, Error *error)
{
    static const char *const stages[] = {"render/backdrop.vert", "render/backdrop.frag", NULL};
    Backdrop *backdrop = state;
    (void)subject;
    if (backdrop->shadow_program)
        return true;
    glCreateVertexArrays(1, &backdrop->vertex_array);
    backdrop->program = program_create("backdrop", stages, NULL, error);
    if (backdrop->program)
        backdrop->shadow_program = program_create("shaded floor", stages, "#define FLOOR_SHADOW 1\n", error);
    return backdrop->shadow_program != 0;
}

static void forget_kept(Backdrop *backdrop)
{
    glDeleteFramebuffers(1, &backdrop->cached_framebuffer);
    glDeleteTextures(1, &backdrop->cached_color);
    backdrop->cached_framebuffer = backdrop->cached_color = backdrop->cached_target = 0;
    backdrop->cached = false;
}

static void backdrop_destroy(void *state)
{
    Backdrop *backdrop = state;
    forget_kept(backdrop);
    glDeleteProgram(backdrop->program);
    glDeleteProgram(backdrop->shadow_program);
    glDeleteVertexArrays(1, &backdrop->vertex_array);
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
    key = append_numbers(key, &frame->floor.height, 1);
    key = append_numbers(key, frame->floor.center, 2);
    key = append_numbers(key, &frame->floor.radius, 1);
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

/* Into the bound framebuffer, of the target's size. */
static void draw_unshaded(const Backdrop *backdrop)
{
    glUseProgram(backdrop->program);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void keep(Backdrop *backdrop, const Frame *frame)
{
    if (backdrop->cached_target != frame->target->number) {
        forget_kept(backdrop);
        glCreateTextures(GL_TEXTURE_2D, 1, &backdrop->cached_color);
        glTextureStorage2D(backdrop->cached_color, 1, GL_SRGB8_ALPHA8, frame->width, frame->height);
        glObjectLabel(GL_TEXTURE, backdrop->cached_color, -1, "kept backdrop");
        glCreateFramebuffers(1, &backdrop->cached_framebuffer);
        glNamedFramebufferTexture(backdrop->cached_framebuffer, GL_COLOR_ATTACHMENT0, backdrop->cached_color,
                                  0);
        glObjectLabel(GL_FRAMEBUFFER, backdrop->cached_framebuffer, -1, "kept backdrop");
        backdrop->cached_target = frame->target->number;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, backdrop->cached_framebuffer);
    draw_unshaded(backdrop);
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    backdrop->cached = true;
}

/* The backdrop is kept from the second picture of a still camera on; a moving camera pays nothing. */
static void copy_kept(Backdrop *backdrop, const Frame *frame)
{
    if (!stands_still(backdrop, frame)) {
        backdrop->cached = false;
        draw_unshaded(backdrop);
        return;
    }
    if (!backdrop->cached)
        keep(backdrop, frame);
    glCopyImageSubData(backdrop->cached_color, GL_TEXTURE_2D, 0, 0, 0, 0, frame->target->color, GL_TEXTURE_2D,
                       0, 0, 0, 0, frame->width, frame->height, 1);
}

static void shade_floor(const Backdrop *backdrop, const Frame *frame)
{
    if (frame->floor.radius <= 0 || frame->camera.eye[1] <= frame->floor.height)
        return;
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor.light);
    glUseProgram(backdrop->shadow_program);
    glDrawArrays(GL_TRIANGLES, 0, 6 * FLOOR_CELLS * FLOOR_CELLS);
}

static void backdrop_draw(void *state, Picture *picture)
{
    Backdrop *backdrop = state;
    const Frame *frame = &picture->frame;
    target_begin(frame->target);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glBindVertexArray(backdrop->vertex_array);
    copy_kept(backdrop, frame);
    shade_floor(backdrop, frame);
}

static const EffectState backdrop_state = {
    .size = sizeof(Backdrop), .prepare = backdrop_prepare, .destroy = backdrop_destroy};

const Effect effect_backdrop = {
    .name = "backdrop", .stage = STAGE_BACKDROP, .state = &backdrop_state, .draw = backdrop_draw};

/* The shadow maps, seen from the light; spheres.frag and the floor read the maps. Solids have a separate
   map, present only in scenes with solids: shadows of solids are full at once, while the fluid's own shadow
   fades with depth. */

/* FLOOR_MAP_TEXELS squared. */
typedef struct FloorMap {
    unsigned framebuffer, texture;
} FloorMap;

typedef struct Shadow {
    unsigned framebuffer, map; /* depth, SHADOW_MAP_TEXELS squared */
    FloorMap rough, floor;     /* light left on the floor: made, and smoothed */
    unsigned floor_program, smooth_program, vertex_array;
    unsigned solid_framebuffer, solid_map, solid_floor_program; /* 0 without solids */
} Shadow;

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

static FloorMap create_floor_map(const char *label)
{
    FloorMap map = {.texture = create_map(GL_R32F, GL_LINEAR, FLOOR_MAP_TEXELS, label)};
    map.framebuffer = create_framebuffer(GL_COLOR_ATTACHMENT0, map.texture, label);
    return map;
}

static void destroy_floor_map(FloorMap *map)
{
    glDeleteFramebuffers(1, &map->framebuffer);
    glDeleteTextures(1, &map->texture);
}

static GLuint create_floor_program(const char *label, const char *defines, Error *error)
{
    static const char *const stages[] = {"common/screen.vert", "render/floor_shadow.frag", NULL};
    return program_create(label, stages, defines, error);
}

static bool shadow_create(Shadow *shadow, Error *error)
{
    if (shadow->floor_program)
        return true;
    shadow->map = create_map(GL_DEPTH_COMPONENT32F, GL_NEAREST, SHADOW_MAP_TEXELS, "shadow map");
    shadow->framebuffer = create_framebuffer(GL_DEPTH_ATTACHMENT, shadow->map, "shadow");
    shadow->rough = create_floor_map("floor shadow, rough");
    shadow->floor = create_floor_map("floor shadow");
    glCreateVertexArrays(1, &shadow->vertex_array);
    shadow->smooth_program =
        program_create_pair("floor shadow, smooth", "common/screen.vert", "render/floor_smooth.frag", error);
    if (shadow->smooth_program)
        shadow->floor_program = create_floor_program("floor shadow", NULL, error);
    return shadow->floor_program != 0;
}

static void drop_solids(Shadow *shadow)
{
    glDeleteFramebuffers(1, &shadow->solid_framebuffer);
    glDeleteTextures(1, &shadow->solid_map);
    glDeleteProgram(shadow->solid_floor_program);
    shadow->solid_framebuffer = shadow->solid_map = shadow->solid_floor_program = 0;
}

static bool shadow_prepare(void *state, const Subject *subject, Error *error)
{
    Shadow *shadow = state;
    if (!shadow_create(shadow, error))
        return false;
    if (subject->world->solid_count == 0 || shadow->solid_map)
        return true;
    shadow->solid_floor_program = create_floor_program("floor shadow, solids", "#define SOLIDS 1\n", error);
    if (!shadow->solid_floor_program)
        return false;
    shadow->solid_map = create_solid_map();
    shadow->solid_framebuffer = create_framebuffer(GL_DEPTH_ATTACHMENT, shadow->solid_map, "solid shadow");
    return true;
}

static void shadow_release(void *state, const Subject *subject)
{
    Shadow *shadow = state;
    if (subject->world->solid_count == 0 && shadow->solid_map)
        drop_solids(shadow);
}

static void shadow_destroy(void *state)
{
    Shadow *shadow = state;
    drop_solids(shadow);
    glDeleteFramebuffers(1, &shadow->framebuffer);
    destroy_floor_map(&shadow->rough);
    destroy_floor_map(&shadow->floor);
    glDeleteTextures(1, &shadow->map);
    glDeleteVertexArrays(1, &shadow->vertex_array);
    glDeleteProgram(shadow->floor_program);
    glDeleteProgram(shadow->smooth_program);
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

static bool has_solids(const Picture *picture)
{
    return picture->frame.world->solid_count > 0;
}

static void draw_solid_shadow(void *state, Picture *picture)
{
    const Shadow *shadow = state;
    begin_map(shadow->solid_framebuffer);
    solids_cast(picture);
}

/* Draws the shadow on the floor if the frame has a floor. */
static void shade_floor_map(const Shadow *shadow, const Frame *frame)
{
    if (frame->floor.radius <= 0)
        return;
    glBindFramebuffer(GL_FRAMEBUFFER, shadow->rough.framebuffer);
    glViewport(0, 0, FLOOR_MAP_TEXELS, FLOOR_MAP_TEXELS);
    glUseProgram(shadow->solid_map ? shadow->solid_floor_program : shadow->floor_program);
    glBindVertexArray(shadow->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindFramebuffer(GL_FRAMEBUFFER, shadow->floor.framebuffer);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, shadow->rough.texture);
    glUseProgram(shadow->smooth_program);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* Leaves the maps bound to texture units: 0, and 4 for solids. */
static void draw_shadow(void *state, Picture *picture)
{
    const Shadow *shadow = state;
    begin_map(shadow->framebuffer);
    if (picture->view)
        view_cast(picture->view, picture->particles, &picture->frame);
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(SHADOW_UNIT, shadow->map);
    if (shadow->solid_map)
        glBindTextureUnit(SOLID_SHADOW_UNIT, shadow->solid_map);
    shade_floor_map(shadow, &picture->frame);
    picture->frame.floor.light = shadow->floor.texture;
}

static const EffectState shadow_state = {
    .size = sizeof(Shadow), .prepare = shadow_prepare, .release = shadow_release, .destroy = shadow_destroy};

const Effect effect_solid_shadow = {.name = "solid_shadow",
                                    .stage = STAGE_SHADOW,
                                    .state = &shadow_state,
                                    .wanted = has_solids,
                                    .draw = draw_solid_shadow};

const Effect effect_shadow = {
    .name = "shadow", .stage = STAGE_SHADOW, .state = &shadow_state, .draw = draw_shadow};
