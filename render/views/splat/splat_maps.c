#include "render/views/splat/splat.h"

#include "render/views/splat/splat_private.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void splat_maps_delete(SplatMaps *maps)
{
    glDeleteFramebuffers(2, (GLuint[]){maps->nearest_framebuffer, maps->blend_framebuffer});
    glDeleteTextures(5, (GLuint[]){maps->nearest, maps->color, maps->normal, maps->weight, maps->limit});
    *maps = (SplatMaps){0};
}

unsigned splat_map_create(unsigned format, const Target *target, const char *label)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glObjectLabel(GL_TEXTURE, map, -1, label);
    glTextureStorage2D(map, 1, format, target->width, target->height);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return map;
}

unsigned splat_framebuffer_create(const unsigned *maps, int count, const char *label)
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

void splat_maps_update(SplatMaps *maps, const Target *target, bool covers)
{
    if (maps->target_number == target->number)
        return;
    splat_maps_delete(maps);
    static const GLfloat none = 0;
    const GLenum sums = gl_renderer_is_software() ? GL_RGBA32F : GL_RGBA16F; /* software drivers compute no
                                                                                halves */
    maps->nearest = splat_map_create(GL_R32F, target, "splat nearest");
    maps->color = splat_map_create(sums, target, "splat color");
    maps->normal = splat_map_create(sums, target, "splat normal");
    maps->weight = splat_map_create(covers ? GL_RG32F : GL_R32F, target, "splat weight");
    maps->nearest_framebuffer = splat_framebuffer_create(&maps->nearest, 1, "splat nearest");
    maps->blend_framebuffer =
        splat_framebuffer_create((GLuint[]){maps->color, maps->normal, maps->weight}, 3, "splat blend");
    maps->limit = splat_map_create(GL_DEPTH_COMPONENT32F, target, "splat limit");
    glClearTexImage(maps->limit, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &none); /* no pass sets the limit outside
                                                                             the box */
    glNamedFramebufferTexture(maps->blend_framebuffer, GL_DEPTH_ATTACHMENT, maps->limit, 0);
    maps->target_number = target->number;
}

uint64_t splat_maps_covered(const SplatMaps *maps, const Target *target)
{
    const size_t pixels = (size_t)target->width * (size_t)target->height;
    uint64_t covered = 0;
    const GLsizei size = (GLsizei)(pixels * sizeof(float));
    float *weight = malloc(2 * (size_t)size);
    if (!weight)
        return 0;
    glGetTextureImage(maps->weight, 0, GL_RED, GL_FLOAT, size, weight);
    glGetTextureImage(maps->nearest, 0, GL_RED, GL_FLOAT, size, weight + pixels);
    for (size_t i = 0; i < pixels; i++)
        covered += weight[i] > 0 && weight[pixels + i] < SPLAT_NOTHING;
    free(weight);
    return covered;
}

bool splat_panes_create(SplatPanes *panes, Error *error)
{
    *panes = (SplatPanes){0};
    panes->cut = program_create_pair("splat panes", FLUID_TILES_VERTEX, "splat/clear/panes.frag", error);
    if (panes->cut)
        panes->brim = program_create_pair("splat brim", FLUID_TILES_VERTEX, "splat/clear/brim.frag", error);
    return panes->brim != 0;
}

static void delete_pane_maps(SplatPanes *panes)
{
    glDeleteFramebuffers(2, panes->framebuffer);
    glDeleteTextures(2, panes->map);
}

void splat_panes_destroy(SplatPanes *panes)
{
    glDeleteProgram(panes->cut);
    glDeleteProgram(panes->brim);
    delete_pane_maps(panes);
    *panes = (SplatPanes){0};
}

static void update_panes(SplatPanes *panes, const Target *target)
{
    if (panes->target_number == target->number)
        return;
    delete_pane_maps(panes);
    for (int i = 0; i < 2; i++) {
        panes->map[i] = splat_map_create(GL_R32F, target, "splat panes");
        panes->framebuffer[i] = splat_framebuffer_create(&panes->map[i], 1, "splat panes");
    }
    panes->target_number = target->number;
}

static void cut_pass(const SplatPanes *panes, int to, unsigned program, unsigned from,
                     const FluidTiles *tiles)
{
    glClearNamedFramebufferfv(panes->framebuffer[to], GL_COLOR, 0, (GLfloat[4]){SPLAT_NOTHING});
    glBindFramebuffer(GL_FRAMEBUFFER, panes->framebuffer[to]);
    glBindTextureUnit(NEAREST_UNIT, from);
    glUseProgram(program);
    fluid_tiles_draw(tiles);
}

SplatMaps splat_panes_draw(SplatPanes *panes, const SplatMaps *maps, const FluidTiles *tiles,
                           const Frame *frame)
{
    SplatMaps cut = *maps;
    update_panes(panes, frame->target);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    cut_pass(panes, 0, panes->cut, maps->nearest, tiles);
    glBindTextureUnit(TARGET_DEPTH_UNIT, maps->nearest);
    cut_pass(panes, 1, panes->brim, panes->map[0], tiles);
    cut.nearest = panes->map[1];
    return cut;
}

static GLuint create_smoothing(const char *label, const char *defines, Error *error)
{
    static const char *const stages[] = {FLUID_TILES_VERTEX, "splat/narrow_range.frag", NULL};
    char all[96];
    snprintf(all, sizeof all, "%s#define TAPS %d\n", defines, NARROW_RANGE_TAPS);
    return program_create(label, stages, all, error);
}

bool narrow_range_create(NarrowRange *filter, bool panes, Error *error)
{
    static const char *const normals[] = {FLUID_TILES_VERTEX, "splat/narrow_range_normals.frag", NULL};
    *filter = (NarrowRange){0};
    filter->along = create_smoothing("narrow range", "", error);
    if (filter->along)
        filter->clean = create_smoothing("narrow range, clean-up", "#define CLEAN 1\n", error);
    if (filter->clean)
        filter->normals =
            program_create("narrow range, normals", normals, panes ? "#define PANES 1\n" : NULL, error);
    return filter->normals != 0;
}

static void delete_filter_maps(NarrowRange *filter)
{
    glDeleteFramebuffers(2, filter->depth_framebuffer);
    glDeleteFramebuffers(1, &filter->normal_framebuffer);
    glDeleteTextures(2, filter->depth);
    glDeleteTextures(1, &filter->normal);
}

void narrow_range_destroy(NarrowRange *filter)
{
    delete_filter_maps(filter);
    glDeleteProgram(filter->along);
    glDeleteProgram(filter->clean);
    glDeleteProgram(filter->normals);
    *filter = (NarrowRange){0};
}

static void update_filter(NarrowRange *filter, const Target *target)
{
    if (filter->target_number == target->number)
        return;
    delete_filter_maps(filter);
    for (int i = 0; i < 2; i++) {
        filter->depth[i] = splat_map_create(GL_R32F, target, "narrow range depth");
        filter->depth_framebuffer[i] = splat_framebuffer_create(&filter->depth[i], 1, "narrow range depth");
    }
    filter->normal =
        splat_map_create(gl_renderer_is_software() ? GL_RGBA32F : GL_RGBA16F, target, "narrow range normal");
    filter->normal_framebuffer = splat_framebuffer_create(&filter->normal, 1, "narrow range normal");
    filter->target_number = target->number;
}

/* Smooths `from` into depth[to]; returns depth[to]. */
static unsigned smooth_along(const NarrowRange *filter, const FluidTiles *tiles, GLuint program,
                             unsigned from, int to, int x, int y)
{
    glBindFramebuffer(GL_FRAMEBUFFER, filter->depth_framebuffer[to]);
    glBindTextureUnit(NEAREST_UNIT, from);
    glUseProgram(program);
    glUniform2i(FILTER_AXIS_AT, x, y);
    fluid_tiles_draw(tiles);
    return filter->depth[to];
}

static void set_filter_uniforms(const NarrowRange *filter, const Frame *frame)
{
    const SplatDef *def = splat_def(frame->def);
    const float radius = frame->radii.drawn, range = (float)def->filter_range * radius;
    const float pixels = 0.5F * (float)frame->height / frame->camera.tangent[1]; /* pixels of 1 m at a
                                                                                    distance of 1 m */
    const float reach = (float)def->filter_size * radius * pixels;
    for (int i = 0; i < 2; i++) {
        const GLuint program = i == 0 ? filter->along : filter->clean;
        glProgramUniform1f(program, FILTER_REACH_AT, reach);
        glProgramUniform1f(program, FILTER_RANGE_AT, range);
    }
    glProgramUniform1f(filter->normals, EDGE_STEP_AT,
                       0.5F * range); /* filtering brings the rim of a gap of one range nearer */
}

SplatMaps narrow_range_draw(NarrowRange *filter, const SplatMaps *maps, const FluidTiles *tiles,
                            const Frame *frame)
{
    SplatMaps shown = *maps;
    update_filter(filter, frame->target);
    set_filter_uniforms(filter, frame);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    for (int i = 0; i < 2; i++)
        glClearNamedFramebufferfv(filter->depth_framebuffer[i], GL_COLOR, 0, (GLfloat[4]){SPLAT_NOTHING});
    for (int i = 0; i < splat_def(frame->def)->filter_iterations; i++) {
        shown.nearest = smooth_along(filter, tiles, filter->along, shown.nearest, 0, 1, 0);
        shown.nearest = smooth_along(filter, tiles, filter->along, shown.nearest, 1, 0, 1);
    }
    shown.nearest = smooth_along(filter, tiles, filter->clean, shown.nearest, 0, 0, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, filter->normal_framebuffer);
    glBindTextureUnit(NEAREST_UNIT, shown.nearest);
    glBindTextureUnit(NORMAL_SUM_UNIT, maps->normal);
    glUseProgram(filter->normals);
    fluid_tiles_draw(tiles);
    shown.normal = filter->normal;
    return shown;
}

/* Least number of texels per support radius, for the farthest particle. */
static const float TEXELS = 2;
static const unsigned COARSEST = 8;

bool splat_thickness_create(SplatThickness *thickness, const SplatSprites *sprites, bool solids, Error *error)
{
    const char *const solid = solids ? "#define SOLIDS 1\n" : NULL;
    const char *defines = solids ? "#define THICKNESS 1\n#define SOLIDS 1\n" : "#define THICKNESS 1\n";
    *thickness = (SplatThickness){0};
    static const char *const fill[] = {"common/screen.vert", "splat/clear/filled.frag", NULL};
    thickness->fill = program_create("splat filled", fill, solid, error);
    if (!thickness->fill)
        return false;
    glCreateVertexArrays(1, &thickness->screen);
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        if (!splat_sprites_can_use(sprites, (SplatSprite)sprite))
            continue;
        thickness->program[sprite] = splat_sprites_program(sprites, (SplatSprite)sprite, false,
                                                           "splat/clear/thickness.frag", defines, error);
        if (!thickness->program[sprite])
            return false;
    }
    return true;
}

static void delete_thickness_maps(SplatThickness *thickness)
{
    glDeleteTextures(2, (GLuint[]){thickness->map, thickness->filled});
    glDeleteFramebuffers(2, (GLuint[]){thickness->framebuffer, thickness->filled_framebuffer});
    thickness->map = thickness->filled = thickness->target_number = 0;
    thickness->framebuffer = thickness->filled_framebuffer = 0;
}

void splat_thickness_destroy(SplatThickness *thickness)
{
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++)
        glDeleteProgram(thickness->program[sprite]);
    glDeleteProgram(thickness->fill);
    glDeleteVertexArrays(1, &thickness->screen);
    delete_thickness_maps(thickness);
}

static unsigned thickness_texels(int pixels, unsigned cell)
{
    return ((unsigned)pixels + cell - 1) / cell;
}

static GLuint create_thickness_map(int width, int height, const char *label)
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

static void update_thickness(SplatThickness *thickness, const Target *target, unsigned cell)
{
    if (thickness->target_number == target->number && thickness->cell == cell)
        return;
    delete_thickness_maps(thickness);
    const int width = (int)thickness_texels(target->width, cell),
              height = (int)thickness_texels(target->height, cell);
    thickness->map = create_thickness_map(width, height, "thickness");
    thickness->filled = create_thickness_map(width, height, "thickness of a full box");
    thickness->framebuffer = splat_framebuffer_create(&thickness->map, 1, "thickness");
    thickness->filled_framebuffer =
        splat_framebuffer_create(&thickness->filled, 1, "thickness of a full box");
    thickness->target_number = target->number;
    thickness->cell = cell;
}

/* Fills only the particles' bounds and a support radius around: other texels are never read. */
static void fill_box(const SplatThickness *thickness, float support, int width, int height,
                     const Frame *frame)
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

void splat_thickness_draw(SplatThickness *thickness, SplatSprites *sprites, const ParticleBuffers *particles,
                          const Frame *frame)
{
    const float far_pixel = pixel_at(frame, fmaxf(frame->extent.farthest, frame->camera.near_plane));
    /* If the support radius is below a pixel, a wider kernel keeps the total right. */
    const float support = fmaxf((float)particles->support_radius, 1.5F * far_pixel);
    const float fitting = support / (TEXELS * far_pixel);
    const unsigned cell = (unsigned)fmaxf(1, fminf(floorf(fitting), (float)COARSEST));
    update_thickness(thickness, frame->target, cell);
    const int width = (int)thickness_texels(frame->width, cell),
              height = (int)thickness_texels(frame->height, cell);
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
