#include "render/views/splat/splat.h"

#include "render/frame/frame.h"
#include "render/particles/particles.h"
#include "render/views/splat/splat_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ViewKind.same. */
static bool splat_is_compatible(const Subject *a, const Subject *b)
{
    return (splat_def(a->def)->level > 0) == (splat_def(b->def)->level > 0);
}

typedef struct SplatView {
    SplatDef def;                                          /* settings compiled into the programs */
    GLuint depth[SPLAT_POINT + 1], blend[SPLAT_POINT + 1]; /* programs, by sprite */
    GLuint limit;                                          /* program */
    ShadowCaster casting;
    ColorTable colors;
    SplatSprites sprites;
    Ellipsoids ellipsoids;
    SplatMaps maps;
    SplatThickness thickness; /* if the shading needs thickness */
    SplatPanes panes;         /* if splat_has_panes */
    NarrowRange filter;       /* if the def has a filter */
    SplatMaps shown;          /* the shaded maps: `maps`, or the results of panes and filter */
    SplatShade shade;
    SplatLevel level;      /* if splat_level_wanted */
    SplatSpray spray;      /* if splat_has_spray */
    Silhouette silhouette; /* if silhouette_wanted */
} SplatView;

const SplatMaps *splat_maps(const void *state)
{
    return &((const SplatView *)state)->maps;
}

const Ellipsoids *splat_ellipsoids(const void *state)
{
    return &((const SplatView *)state)->ellipsoids;
}

unsigned splat_thickness_map(const void *state)
{
    return ((const SplatView *)state)->thickness.map;
}

const SplatMaps *splat_shown_maps(const void *state)
{
    return &((const SplatView *)state)->shown;
}

static void splat_destroy(void *state)
{
    SplatView *splat = state;
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++) {
        glDeleteProgram(splat->depth[sprite]);
        glDeleteProgram(splat->blend[sprite]);
    }
    glDeleteProgram(splat->limit);
    shadow_caster_destroy(&splat->casting);
    color_table_destroy(&splat->colors);
    splat_level_destroy(&splat->level);
    splat_maps_delete(&splat->maps);
    splat_panes_destroy(&splat->panes);
    narrow_range_destroy(&splat->filter);
    silhouette_destroy(&splat->silhouette);
    splat_spray_destroy(&splat->spray);
    splat_sprites_destroy(&splat->sprites);
    ellipsoids_destroy(&splat->ellipsoids);
    splat_thickness_destroy(&splat->thickness);
    splat_shade_destroy(&splat->shade);
    free(splat);
}

static bool create_sprites(SplatView *splat, SplatSprite sprite, Error *error)
{
    char blend[96];
    const char *const file =
        splat_level_wanted(&splat->def) ? "splat/splat_level_blend.frag" : "splat/splat_blend.frag";
    const char *const discs = silhouette_by_discs(&splat->def) ? "#define DISCS 1\n" : "";
    const bool listed = splat_culls(&splat->def);
    snprintf(blend, sizeof blend, "#define BLEND 1\n#define WEIGHTS %d\n%s", (int)splat->def.weights, discs);
    splat->depth[sprite] =
        splat_sprites_program(&splat->sprites, sprite, listed, "splat/splat_depth.frag", discs, error);
    if (splat->depth[sprite])
        splat->blend[sprite] = splat_sprites_program(&splat->sprites, sprite, listed, file, blend, error);
    return splat->blend[sprite] != 0;
}

static bool create_programs(SplatView *splat, Error *error)
{
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++)
        if (splat_sprites_can_use(&splat->sprites, (SplatSprite)sprite) &&
            !create_sprites(splat, (SplatSprite)sprite, error))
            return false;
    splat->limit = program_create_pair("splat limit", FLUID_TILES_VERTEX, "splat/splat_limit.frag", error);
    return splat->limit && shadow_caster_create(&splat->casting, ellipsoids_defines(&splat->def), error);
}

static bool create_shading(SplatView *splat, const Subject *subject, Error *error)
{
    if (splat_shade_wants_thickness(&splat->def) &&
        !splat_thickness_create(&splat->thickness, &splat->sprites, subject->world->solid_count > 0, error))
        return false;
    return splat_shade_create(&splat->shade, subject, error);
}

/* Creates the passes that only some settings need, and the shading. */
static bool create_passes(SplatView *splat, const Subject *subject, Error *error)
{
    const SplatDef *own = &splat->def;
    return (!splat_level_wanted(own) || splat_level_create(&splat->level, &splat->sprites, error)) &&
           (!splat_has_panes(own) || splat_panes_create(&splat->panes, error)) &&
           (own->filter == SPLAT_NO_FILTER ||
            narrow_range_create(&splat->filter, splat_has_panes(own), error)) &&
           (!splat_has_spray(own) || splat_spray_create(&splat->spray, &splat->sprites, subject, error)) &&
           (!silhouette_wanted(own) || silhouette_create(&splat->silhouette, subject, error)) &&
           create_shading(splat, subject, error);
}

static void *splat_create(const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    SplatView *splat = calloc(1, sizeof *splat);
    if (!splat) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    splat->def = splat_def_resolved(subject->def);
    if (color_table_create(&splat->colors, view_colormap(def), &def->color_curve, error) &&
        splat_sprites_create(&splat->sprites, &splat->def, error) &&
        ellipsoids_create(&splat->ellipsoids, &splat->def, error) && create_programs(splat, error) &&
        create_passes(splat, subject, error))
        return splat;
    splat_destroy(splat);
    return NULL;
}

static void splat_prepare(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SplatView *splat = state;
    if (ellipsoids_wanted(&splat->def))
        GL_STAGE(frame->timer, STAGE_VISIBILITY)
        {
            ellipsoids_make(&splat->ellipsoids, particles, frame);
        }
}

static void splat_cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    const SplatView *splat = state;
    (void)frame;
    ellipsoids_bind(&splat->ellipsoids);
    shadow_caster_draw(&splat->casting, particles);
}

static void draw_sprites(SplatView *splat, SplatSprite sprite, GLuint program,
                         const ParticleBuffers *particles, const Frame *frame, SplatCullList list)
{
    splat_sprites_draw(&splat->sprites, sprite, program, particles, frame,
                       splat_culls(&splat->def) ? &list : NULL);
}

static float eps_of(const Frame *frame)
{
    return (float)splat_def(frame->def)->eps * frame->radii.drawn;
}

/* Depth range behind the nearest sphere in which spheres matter, m. */
static float reach_of(const SplatView *splat, const Frame *frame)
{
    return splat_level_wanted(&splat->def) ? splat_level_range(frame) : eps_of(frame);
}

static void find_nearest(SplatView *splat, SplatSprite sprite, const ParticleBuffers *particles,
                         const Frame *frame)
{
    const bool hidden = splat->def.show == SPLAT_CULLED;
    FluidTiles *tiles = &splat->sprites.tiles;
    fluid_tiles_update(tiles, frame->target);
    splat->sprites.cull.marks = tiles->marks;
    if (splat_culls(&splat->def))
        splat_cull_for_eye(&splat->sprites.cull, particles, frame, reach_of(splat, frame),
                           sprite == SPLAT_POINT ? 1 : 6, hidden);
    fluid_tiles_list(tiles, frame, !splat_culls(&splat->def) || splat_level_wanted(&splat->def));
    glClearNamedFramebufferfv(splat->maps.nearest_framebuffer, GL_COLOR, 0, (GLfloat[4]){SPLAT_NOTHING});
    splat_sprites_begin(splat->maps.nearest_framebuffer, frame, GL_MIN);
    counts_begin(frame->counts);
    draw_sprites(splat, sprite, splat->depth[sprite], particles, frame, CULL_NEAREST);
    counts_end(frame->counts, STAGE_VISIBILITY);
    if (splat_level_wanted(&splat->def))
        splat_level_find(&splat->level, &splat->maps, &splat->sprites, sprite, particles, frame);
}

/* Sets the depth limit of blending, and clears the sums. */
static void set_limit(SplatView *splat, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, splat->maps.blend_framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    glBindTextureUnit(NEAREST_UNIT, splat->maps.nearest);
    glUseProgram(splat->limit);
    glUniform1f(EPS_AT, eps_of(frame));
    fluid_tiles_draw(&splat->sprites.tiles);
}

static void blend_attributes(SplatView *splat, SplatSprite sprite, const ParticleBuffers *particles,
                             const Frame *frame)
{
    const bool level = splat_level_wanted(&splat->def); /* the search for the level has set the limit */
    for (int i = 0; level && i < 3; i++)
        glClearNamedFramebufferfv(splat->maps.blend_framebuffer, GL_COLOR, i, (GLfloat[4]){0});
    if (!level)
        set_limit(splat, frame);
    splat_sprites_begin(splat->maps.blend_framebuffer, frame, GL_FUNC_ADD);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    if (level)
        glProgramUniform1f(splat->blend[sprite], KERNEL_GAIN_AT, splat_level_gain_of(frame, particles));
    else
        glProgramUniform1f(splat->blend[sprite], EPS_AT, eps_of(frame));
    glBindTextureUnit(NEAREST_UNIT, splat->maps.nearest);
    color_table_bind(&splat->colors, &frame->def->color_curve);
    counts_begin(frame->counts);
    draw_sprites(splat, sprite, splat->blend[sprite], particles, frame, CULL_BLEND);
    counts_end(frame->counts, STAGE_BLEND);
    glDisable(GL_BLEND);
}

/* Fluid farther behind by this distance, m, is a separate surface. Levels are smooth and have no eps. */
static float apart(const SplatView *splat, const Frame *frame)
{
    return splat_level_wanted(&splat->def) ? frame->radii.drawn / 2 : eps_of(frame);
}

static void draw_spray(SplatView *splat, SplatSprayPart part, SplatSprite sprite,
                       const ParticleBuffers *particles, const Frame *frame)
{
    if (splat_has_spray(&splat->def))
        GL_STAGE(frame->timer, STAGE_SHADE)
        {
            if (part == SPRAY_BEHIND)
                splat_spray_find(&splat->spray, sprite, particles);
            color_table_bind(&splat->colors, &frame->def->color_curve); /* other passes have used the
                                                                           texture unit */
            splat_spray_draw(&splat->spray, part, splat->shown.nearest, &splat->shade.background,
                             &splat->shade.edges, &splat->sprites, sprite, particles, frame);
        }
}

static void splat_draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SplatView *splat = state;
    const SplatSprite sprite =
        splat_sprites_choose(&splat->sprites, frame, frame->radii.reach, (float)frame->height);
    splat_maps_update(&splat->maps, frame->target, silhouette_by_discs(&splat->def));
    ellipsoids_bind(&splat->ellipsoids);
    GL_STAGE(frame->timer, STAGE_VISIBILITY)
    find_nearest(splat, sprite, particles, frame);
    GL_STAGE(frame->timer, STAGE_BLEND)
    blend_attributes(splat, sprite, particles, frame);
    if (splat_shade_wants_thickness(&splat->def))
        GL_STAGE(frame->timer, STAGE_THICKNESS)
        {
            splat_thickness_draw(&splat->thickness, &splat->sprites, particles, frame);
        }
    splat->shown = splat->maps;
    if (splat_has_panes(&splat->def))
        GL_STAGE(frame->timer, STAGE_FILTER)
        {
            splat->shown = splat_panes_draw(&splat->panes, &splat->maps, &splat->sprites.tiles, frame);
        }
    if (splat->def.filter == SPLAT_NARROW_RANGE)
        GL_STAGE(frame->timer, STAGE_FILTER)
        {
            splat->shown = narrow_range_draw(&splat->filter, &splat->shown, &splat->sprites.tiles, frame);
        }
    draw_spray(splat, SPRAY_BEHIND, sprite, particles, frame);
    GL_STAGE(frame->timer, STAGE_SHADE)
    splat_shade_draw(&splat->shade, &splat->shown, &splat->thickness, &splat->sprites.tiles, frame);
    if (silhouette_wanted(&splat->def))
        GL_STAGE(frame->timer, STAGE_ANTIALIAS)
        {
            silhouette_draw(&splat->silhouette, &splat->maps, splat->shown.nearest, apart(splat, frame),
                            &splat->sprites.tiles, frame);
        }
    draw_spray(splat, SPRAY_BEFORE, sprite, particles, frame);
    if (frame->counts)
        counts_finish(frame->counts, splat_maps_covered(&splat->maps, frame->target),
                      (uint64_t)frame->width * (uint64_t)frame->height);
}

/* A field needs the solver's support radius: smaller radii give ripples too large for a level. The shadow
   is of balls with the radius of a lone particle at the level, at least half a spacing. */
static void level_radii(const ViewDef *def, const ParticleBuffers *particles, ParticleRadii *radii)
{
    const double spacing = particles->spacing;
    radii->drawn = (float)(def->radius > 0 ? def->radius * spacing : particles->support_radius);
    radii->reach = radii->drawn;
    const double gain = splat_level_gain(radii->drawn, spacing, frame_slab_depth(particles) > 0);
    const double alone = splat_level_lone_distance(splat_def(def)->level, gain, radii->drawn);
    radii->shadow = (float)fmax(alone, 0.5 * spacing);
}

static void splat_radii(const ViewDef *def, const ParticleBuffers *particles, ParticleRadii *radii)
{
    if (splat_def(def)->level > 0)
        level_radii(def, particles, radii);
    else {
        const float unit = (float)ellipsoids_size_factor(def, particles);
        radii->drawn *= unit, radii->shadow *= unit;
        radii->reach = radii->drawn * (ellipsoids_stretched(splat_def(def)) ? (float)ELLIPSOID_REACH : 1);
    }
}

static const ViewShapes *splat_shapes(const ViewDef *def)
{
    static const ViewShapes ellipsoids = {"of ellipsoids", 3 * 4 * sizeof(float)};
    return splat_shape(splat_def(def)) == SPLAT_ELLIPSOID ? &ellipsoids : NULL;
}

static ViewProbing splat_probing(const void *state, const ViewDef *def)
{
    (void)state, (void)def;
    return (ViewProbing){.by = VIEW_PROBE_MEAN};
}

static bool splat_own_colors(const ViewDef *def)
{
    return splat_def(def)->shading != SPLAT_PHONG;
}

static void splat_show_in(const ViewDef *def, Frame *frame)
{
    frame->fluid.clear = splat_is_clear(splat_def(def)) ? CLEAR_FLUID_LIGHT : 0;
    frame->fluid.refraction = (float)splat_def(def)->ior;
}

/* The filter takes more than half of a picture's time. */
static bool splat_is_expensive(const ViewDef *def)
{
    return splat_filter(splat_def(def)) != SPLAT_NO_FILTER;
}

/* A filtered surface loses little by fewer pixels; with twice the pixels the filter takes six times as long.
 */
static void splat_quality(ViewDef *def, ViewQuality quality)
{
    if (splat_is_expensive(def) && def->resolution == 1)
        def->resolution = quality == VIEW_DRAFT ? 0.5 : 1.5;
    /* In a best picture the samples of each pixel smooth the outlines. */
    const bool sampled = quality == VIEW_BEST && def->resolution >= 1;
    if ((quality == VIEW_DRAFT || sampled) && splat_def(def)->antialias == splat_usual.antialias)
        splat_def(def)->antialias = false;
}

static void splat_want(const ViewDef *def, ParticleWants *wants)
{
    const SplatDef own = splat_def_resolved(def);
    wants->neighbours |= ellipsoids_crowded(&own);
}

static const KeyOwner spheres = {.key = "view.splat.level", .value = "0"};

const ViewKind view_splat = {
    .name = "splat",
    .help = "one smooth surface, blended from spheres",
    .radius = 1, /* one spacing: neighbours at rest overlap enough to leave no hole */
    .curves = VIEW_SIZE,
    .curves_where = &spheres,
    .radii = splat_radii,
    .shapes = splat_shapes,
    .own_colors = splat_own_colors,
    .expensive = splat_is_expensive,
    .quality = splat_quality,
    .show = splat_show_in,
    .create = splat_create,
    .destroy = splat_destroy,
    .keys = splat_keys,
    .grades = splat_grades,
    .def = &splat_usual,
    .def_size = sizeof splat_usual,
    .same = splat_is_compatible,
    .want = splat_want,
    .prepare = splat_prepare,
    .cast = splat_cast,
    .draw = splat_draw,
    .probing = splat_probing,
};
