#include "render/splat.h"

#include "render/colormap.h"
#include "render/cull.h"
#include "render/particle_bind.h"
#include "render/shadow.h"
#include "sim/gl/program.h"
#include "sim/gl/timer.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct SplatView {
    SplatDef def;                                          /* what the programs were made for */
    GLuint depth[SPLAT_POINT + 1], blend[SPLAT_POINT + 1]; /* programs, by sprite */
    GLuint limit, shading, casting, casting_listed;        /* programs; the last where culling does */
    float point_limit; /* largest point that the driver draws, pixels; 0 on hardware: quads cost no more there
                        */
    GLuint colormap;
    GLuint screen; /* vertex array without attributes */
    QuadIndices quads;
    Cull cull; /* where def.cull */
    SplatMaps maps;
} SplatView;

/* In nearest_map where no sphere is; as in splat_depth.frag. */
static const GLfloat NOTHING = 1e30F;

const SplatMaps *splat_maps(const void *state)
{
    return &((const SplatView *)state)->maps;
}

static void delete_maps(SplatMaps *maps)
{
    glDeleteFramebuffers(2, (GLuint[]){maps->nearest_framebuffer, maps->blend_framebuffer});
    glDeleteTextures(5, (GLuint[]){maps->nearest, maps->color, maps->normal, maps->weight, maps->limit});
    *maps = (SplatMaps){0};
}

static void splat_destroy(void *state)
{
    SplatView *splat = state;
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++) {
        glDeleteProgram(splat->depth[sprite]);
        glDeleteProgram(splat->blend[sprite]);
    }
    glDeleteProgram(splat->limit);
    glDeleteProgram(splat->shading);
    glDeleteProgram(splat->casting);
    glDeleteProgram(splat->casting_listed);
    glDeleteTextures(1, &splat->colormap);
    glDeleteVertexArrays(1, &splat->screen);
    delete_maps(&splat->maps);
    cull_destroy(&splat->cull);
    quad_indices_destroy(&splat->quads);
    free(splat);
}

static const char LISTED[] = "#define LISTED 1\n";

/* To see what culling left out wants it too. */
static bool culls(const SplatView *splat)
{
    return splat->def.cull || splat->def.show == SPLAT_CULLED;
}

static bool may_draw(const SplatView *splat, SplatSprite sprite)
{
    return splat->def.sprite == sprite ||
           (splat->def.sprite == SPLAT_AUTO && (sprite == SPLAT_QUAD || splat->point_limit > 0));
}

static bool create_sprites(SplatView *splat, SplatSprite sprite, Error *error)
{
    static const char *const depth[] = {"render/splat.vert", "render/splat_depth.frag", NULL};
    static const char *const blend[] = {"render/splat.vert", "render/splat_blend.frag", NULL};
    const SplatDef *def = &splat->def;
    char shape[128], all[256];
    snprintf(shape, sizeof shape, "%s%s%s", def->shape == SPLAT_PAPER ? "#define PAPER 1\n" : "",
             sprite == SPLAT_POINT ? "#define POINT 1\n" : "", culls(splat) ? LISTED : "");
    snprintf(all, sizeof all, "%s#define BLEND 1\n#define WEIGHTS %d\n", shape, (int)def->weights);
    splat->depth[sprite] = program_create("splat depth", depth, shape, error);
    splat->blend[sprite] = splat->depth[sprite] ? program_create("splat blend", blend, all, error) : 0;
    return splat->blend[sprite] != 0;
}

/* For the shadow map, where the light culls and where it cannot. */
static GLuint create_casting(const char *defines, Error *error)
{
    static const char *const stages[] = {"render/spheres_shadow.vert", "render/depth_only.frag", NULL};
    const GLuint program = program_create("splat shadow", stages, defines, error);
    if (program)
        glProgramUniform1f(program, 1, SHADOW_MAP_TEXELS);
    return program;
}

static bool create_programs(SplatView *splat, bool solids, Error *error)
{
    static const char *const shading[] = {"common/screen.vert", "render/splat_shade.frag", NULL};
    char defines[128];
    snprintf(defines, sizeof defines, "%s#define SHOW %d\n", solids ? "#define SOLIDS 1\n" : "",
             (int)splat->def.show);
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++)
        if (may_draw(splat, (SplatSprite)sprite) && !create_sprites(splat, (SplatSprite)sprite, error))
            return false;
    splat->limit = program_create_pair("splat limit", "common/screen.vert", "render/splat_limit.frag", error);
    if (!splat->limit)
        return false;
    splat->shading = program_create("splat shade", shading, defines, error);
    splat->casting = splat->shading ? create_casting(NULL, error) : 0;
    if (!splat->casting || !culls(splat))
        return splat->casting != 0;
    splat->casting_listed = create_casting(LISTED, error);
    return splat->casting_listed && cull_create(&splat->cull, splat->def.shape, error);
}

static void *splat_create(const ViewDef *def, Error *error)
{
    SplatView *splat = calloc(1, sizeof *splat);
    if (!splat) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    splat->def = def->splat;
    splat->colormap = colormap_texture(def->colormap);
    if (!splat->colormap)
        error_set(error, "unknown colormap \"%s\"; viridis is the default", def->colormap);
    glCreateVertexArrays(1, &splat->screen);
    quad_indices_create(&splat->quads);
    splat->point_limit = point_limit();
    if (splat->colormap && create_programs(splat, def->solid_count > 0, error))
        return splat;
    splat_destroy(splat);
    return NULL;
}

static GLuint create_map(GLenum format, const Target *target, const char *label)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glObjectLabel(GL_TEXTURE, map, -1, label);
    glTextureStorage2D(map, 1, format, target->width, target->height);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return map;
}

static GLuint create_framebuffer(const GLuint *maps, GLsizei count, const char *label)
{
    static const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    GLuint framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, label);
    for (int i = 0; i < count; i++)
        glNamedFramebufferTexture(framebuffer, buffers[i], maps[i], 0);
    glNamedFramebufferDrawBuffers(framebuffer, count, buffers);
    return framebuffer;
}

static void follow_target(SplatMaps *maps, const Target *target)
{
    if (maps->target_number == target->number)
        return;
    delete_maps(maps);
    const GLenum sums = gl_renderer_is_software() ? GL_RGBA32F : GL_RGBA16F; /* no halves in its hardware */
    maps->nearest = create_map(GL_R32F, target, "splat nearest");
    maps->color = create_map(sums, target, "splat color");
    maps->normal = create_map(sums, target, "splat normal");
    maps->weight = create_map(GL_R32F, target, "splat weight");
    maps->nearest_framebuffer = create_framebuffer(&maps->nearest, 1, "splat nearest");
    maps->blend_framebuffer =
        create_framebuffer((GLuint[]){maps->color, maps->normal, maps->weight}, 3, "splat blend");
    maps->limit = create_map(GL_DEPTH_COMPONENT32F, target, "splat limit");
    glNamedFramebufferTexture(maps->blend_framebuffer, GL_DEPTH_ATTACHMENT, maps->limit, 0);
    maps->target_number = target->number;
}

static void draw_points(SplatView *splat, const ParticleBuffers *particles, const size_t *command)
{
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(splat->screen);
    if (particles->count == 0)
        return;
    if (!command) {
        glDrawArrays(GL_POINTS, 0, (GLsizei)particles->count);
        return;
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, splat->cull.commands);
    glDrawArraysIndirect(GL_POINTS, (const char *)NULL + *command);
}

static void splat_cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SplatView *splat = state;
    const bool listed = culls(splat) && cull_for_light(&splat->cull, particles, frame);
    const size_t command = listed ? cull_use(&splat->cull, CULL_NEAREST) : 0;
    const GLuint program = listed ? splat->casting_listed : splat->casting;
    glUseProgram(program);
    particle_bind(program, particles, frame->def->color_by);
    draw_points(splat, particles, listed ? &command : NULL);
}

/* An upper bound of the pixels across of the largest sphere, at the rim of the picture. */
static SplatSprite choose_sprite(const SplatView *splat, const Frame *frame)
{
    const float *tangent = frame->camera.tangent, r = frame->particle_radius;
    const float slant = 1 + tangent[0] * tangent[0] + tangent[1] * tangent[1];
    if (splat->def.sprite != SPLAT_AUTO)
        return splat->def.sprite;
    if (splat->point_limit <= 0 || frame->nearest <= r)
        return SPLAT_QUAD;
    const float across = r / frame->nearest * slant / tangent[1] * (float)frame->height + 1;
    return across < splat->point_limit ? SPLAT_POINT : SPLAT_QUAD;
}

static void draw_sprites(SplatView *splat, SplatSprite sprite, GLuint program,
                         const ParticleBuffers *particles, const Frame *frame, CullList list)
{
    const size_t command = culls(splat) ? cull_use(&splat->cull, list) : 0;
    glUseProgram(program);
    particle_bind(program, particles, frame->def->color_by);
    if (sprite == SPLAT_POINT)
        draw_points(splat, particles, culls(splat) ? &command : NULL);
    else if (culls(splat))
        quad_indices_draw_indirect(&splat->quads, particles->count, splat->cull.commands, command);
    else
        quad_indices_draw(&splat->quads, particles->count);
}

static float eps_of(const Frame *frame)
{
    return (float)frame->def->splat.eps * frame->particle_radius;
}

/* What the sprites of pass 1 and 2 have in common: they mix with what is there, and know no depth buffer. */
static void begin_sprites(GLuint framebuffer, const Frame *frame, GLenum equation)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(equation);
    glBlendFunc(GL_ONE, GL_ONE);
}

static void find_nearest(SplatView *splat, SplatSprite sprite, const ParticleBuffers *particles,
                         const Frame *frame)
{
    const bool hidden = splat->def.show == SPLAT_CULLED;
    if (culls(splat))
        cull_for_eye(&splat->cull, particles, frame, eps_of(frame), sprite == SPLAT_POINT ? 1 : 6, hidden);
    glClearNamedFramebufferfv(splat->maps.nearest_framebuffer, GL_COLOR, 0, (GLfloat[4]){NOTHING});
    begin_sprites(splat->maps.nearest_framebuffer, frame, GL_MIN);
    draw_sprites(splat, sprite, splat->depth[sprite], particles, frame, CULL_NEAREST);
}

static void set_limit(SplatView *splat, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, splat->maps.blend_framebuffer);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBindTextureUnit(1, splat->maps.nearest);
    glUseProgram(splat->limit);
    glUniform1f(1, eps_of(frame));
    glBindVertexArray(splat->screen);
    frame_cut_to_bounds(frame);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

static void blend_attributes(SplatView *splat, SplatSprite sprite, const ParticleBuffers *particles,
                             const Frame *frame)
{
    for (int i = 0; i < 3; i++)
        glClearNamedFramebufferfv(splat->maps.blend_framebuffer, GL_COLOR, i, (GLfloat[4]){0});
    set_limit(splat, frame);
    begin_sprites(splat->maps.blend_framebuffer, frame, GL_FUNC_ADD);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glProgramUniform1f(splat->blend[sprite], 1, eps_of(frame));
    glBindTextureUnit(1, splat->maps.nearest);
    glBindTextureUnit(2, splat->colormap);
    draw_sprites(splat, sprite, splat->blend[sprite], particles, frame, CULL_BLEND);
    glDisable(GL_BLEND);
}

/* Solids are in the target already: the test of depth says who hides whom. */
static void shade_surface(SplatView *splat, const Frame *frame)
{
    const SplatMaps *maps = &splat->maps;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindTextureUnit(1, maps->nearest);
    glBindTextures(5, 3, (GLuint[]){maps->color, maps->normal, maps->weight});
    glUseProgram(splat->shading);
    glUniform2f(1, fmaxf(frame->nearest, frame->camera.near_plane), frame->farthest);
    glBindVertexArray(splat->screen);
    frame_cut_to_bounds(frame);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

static void splat_draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SplatView *splat = state;
    const SplatSprite sprite = choose_sprite(splat, frame);
    follow_target(&splat->maps, frame->target);
    GL_STAGE(frame->timer, STAGE_VISIBILITY)
    find_nearest(splat, sprite, particles, frame);
    GL_STAGE(frame->timer, STAGE_BLEND)
    blend_attributes(splat, sprite, particles, frame);
    GL_STAGE(frame->timer, STAGE_SHADE)
    shade_surface(splat, frame);
}

const ViewKind view_splat = {
    .name = "splat",
    .help = "one smooth surface, blended from spheres",
    .radius = 1, /* a spacing: neighbours at rest overlap so far that no hole is left */
    .create = splat_create,
    .destroy = splat_destroy,
    .cast = splat_cast,
    .draw = splat_draw,
};
