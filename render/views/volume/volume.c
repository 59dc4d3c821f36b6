#include "render/views/volume/volume.h"

#include "render/particles/particles.h"
#include "render/views/volume/volume_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/base/key_rows.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

const char *const volume_bounds_names[] = {[VOLUME_BOX] = "box", [VOLUME_FLUID] = "fluid", NULL};
const char *const volume_method_names[] = {[VOLUME_AUTO] = "auto",       [VOLUME_GEOMETRY] = "geometry",
                                           [VOLUME_LAYERS] = "layers",   [VOLUME_PLANES] = "planes",
                                           [VOLUME_SCATTER] = "scatter", [VOLUME_GATHER] = "gather",
                                           [VOLUME_SLABS] = "slabs",     [VOLUME_IWASAKI] = "iwasaki",
                                           [VOLUME_DIRECT] = "direct",   NULL};
const char *const volume_show_names[] = {[VOLUME_SHADED] = "shaded",   [VOLUME_SLICE] = "slice",
                                         [VOLUME_ENTRY] = "entry",     [VOLUME_EXIT] = "exit",
                                         [VOLUME_LENGTH] = "length",   [VOLUME_STEPS] = "steps",
                                         [VOLUME_NORMALS] = "normals", NULL};
const char *const volume_solids_names[] = {
    [VOLUME_SOLIDS_SURFACE] = "surface", [VOLUME_SOLIDS_VOXELS] = "voxels", NULL};
const char *const volume_surface_names[] = {
    [VOLUME_RAYS] = "rays", [VOLUME_MESH] = "mesh", [VOLUME_FACETS] = "facets", NULL};
const char *const volume_axis_names[] = {"x", "y", "z", NULL};
const char *const raycast_look_names[] = {
    [RAYCAST_OPAQUE] = "opaque", [RAYCAST_WATER] = "water", [RAYCAST_TRANSLUCENT] = "translucent", NULL};

/* Above the ramp, inside the fluid, the last y applies. */
const ControlPreset volume_presets[] = {{"ramp", {2, {0, 1}, {0, 1}}},
                                        {"fog", {2, {0, 1}, {0, 0.2}}},
                                        {"surface", {4, {0, 0.45, 0.55, 1}, {0, 0, 1, 1}}},
                                        {"shell", {4, {0, 0.3, 0.7, 1}, {0, 1, 1, 0}}},
                                        {NULL, {0}}};

const VolumeDef volume_usual = {
    .cells = 128,
    .slice_axis = 2,
    .slice = 0.5,
    .raycast = {.level = 0.5, /* the field at a plane surface: the fluid fills half the space */
                .step = 1,
                .threshold = 0.99, /* the rest is 2 of 255 */
                .ramp = {0.35, 0.65},
                .opacity = 0.04,
                .skin = 0.4,
                .curve = {2, {0, 1}, {0, 1}},
                .ior = 1.333,
                .shadows = true,
                .jitter = true,
                .skip = true}};

#define AT(field) offsetof(VolumeDef, field)

/* The looks that alone read some keys. */
static const KeyOwner translucent = {.key = "view.volume.look", .value = "translucent"},
                      water = {.key = "view.volume.look", .value = "water"},
                      surfaces = {.key = "view.volume.look",
                                  .unless = "translucent",
                                  .need = "view.volume.look: opaque or water"};

/* clang-format off */
const Key volume_keys[] = {
    MAPPING("view.volume", "of the view volume: the fluid's field on a grid of voxels"),
    INTEGER("view.volume.cells", L, 4, 4096, AT(cells), "along the box's longest side, where cell is 0; cells are never wider than the support radius"),
    NUMBER("view.volume.cell", L, "spacings", 0, 10, AT(cell), "side of a cell; auto, 0: by cells", .zero = "auto"),
    CHOICE_OF("view.volume.bounds", L | KEY_INDEX, volume_bounds_names, AT(bounds),
           "of the volume: the box's, or those that the fluid has in each picture"),
    CHOICE_OF("view.volume.method", L | KEY_INDEX | KEY_REBUILD, volume_method_names, AT(method),
           "how the volume is made: see docs/manual/views/volume.md; direct: none, the field is summed where it is sampled"),
    CHOICE_OF("view.volume.show", L | KEY_INDEX | KEY_REBUILD, volume_show_names, AT(show), "a stage of the way to the picture"),
    CHOICE_OF("view.volume.solids", L | KEY_INDEX | KEY_REBUILD, volume_solids_names, AT(solids),
           "how solids are drawn: their surfaces as in other views, or voxels as the fluid's, by raycasting"),
    CHOICE_OF("view.volume.surface", L | KEY_INDEX | KEY_REBUILD, volume_surface_names, AT(surface),
           "of opaque and water: where rays meet the level, or a mesh of triangles by marching cubes, smooth or as facets with their edges", .owner = &surfaces),
    CHOICE_OF("view.volume.slice_axis", L | KEY_INDEX, volume_axis_names, AT(slice_axis),
           "what the slice shown lies across"),
    NUMBER("view.volume.slice", L, "", 0, 1, AT(slice), "where the slice is along that axis of the box"),
    CHOICE_OF("view.volume.look", L | KEY_INDEX | KEY_REBUILD, raycast_look_names, AT(raycast.look),
           "opaque: a surface; water: one that bends what is behind and mirrors the sky; translucent: by the transfer function, which is the next five"),
    NUMBER("view.volume.opacity", L, "", 0, 1, AT(raycast.opacity), "full opacity: of fluid one spacing deep", .owner = &translucent),
    NUMBER("view.volume.skin", L, "", 0, 1, AT(raycast.skin), "opacity of each surface that a ray crosses", .owner = &translucent),
    NUMBER("view.volume.ramp_from", L, "", 0, 10, AT(raycast.ramp[0]), "the field at which opacity begins", .owner = &translucent),
    NUMBER("view.volume.ramp_to", L, "", 0, 10, AT(raycast.ramp[1]), "and at which it is full; not above: at once", .owner = &translucent),
    POINTS("view.volume.curve", L, 0, 1, volume_presets, AT(raycast.curve),
           "the share of the full opacity, by where the field is between these two; the skin goes with its ups and downs", .owner = &translucent),
    NUMBER("view.volume.level", L | O, "", 0, 10, AT(raycast.level),
           "of the field, where the surface of opaque and water is; a fluid that ends at a plane has 0.5 there"),
    NUMBER("view.volume.ior", L, "", 1, 3, AT(raycast.ior), "index of refraction, of water", .owner = &water),
    NUMBER("view.volume.attenuation", L, "m", 0, 1e5, AT(raycast.attenuation),
           "of water: through which white light becomes the fluid's colour; 0: two fifths of the box's longest side", .owner = &water),
    NUMBER("view.volume.step", L | O, "cells", 0, 10, AT(raycast.step), "between two samples of a ray"),
    NUMBER("view.volume.threshold", L | O, "", 0, 1, AT(raycast.threshold), "opacity at which a ray ends; 1: never"),
    BOOLEAN("view.volume.shadows", L | KEY_REBUILD, AT(raycast.shadows), "of the fluid on itself by marching to the light, instead of the shadow map"),
    BOOLEAN("view.volume.jitter", L, AT(raycast.jitter), "start rays at different parts of a step, so that no bands show"),
    BOOLEAN("view.volume.skip", L, AT(raycast.skip), "cast rays between the faces of what is occupied; else of the whole volume"),
    KEYS_END,
};
/* clang-format on */

const ViewGrade volume_grades[] = {
    {"view.volume.cells", {"24", "48", "96", "192"}, "view.volume.cell", "0", false},
    {"view.volume.method", {"geometry", "layers", "planes", "scatter", "gather", "slabs"}, NULL, NULL, true},
    {"view.volume.step", {"4", "2", "1", "0.5", "0.25"}, NULL, NULL, false},
    {"view.volume.threshold", {"0.9", "0.99", "0.999"}, NULL, NULL, false},
    {"view.volume.shadows", {"false", "true"}, NULL, NULL, false},
    {"view.volume.jitter", {"true", "false"}, NULL, NULL, false},
    {"view.volume.skip", {"false", "true"}, NULL, NULL, true},
    {0},
};

/* One slice of a volume as a picture, for inspection. */
typedef struct VolumeSlice {
    unsigned program, vertex_array;
    ColorTable colors;
} VolumeSlice;

/* For volumes of `voxelizer`. Returns false if a shader does not compile or the def's colormap is unknown;
   call volume_slice_destroy in either case. */
static bool volume_slice_create(VolumeSlice *slice, const ViewDef *def, const Voxelizer *voxelizer,
                                Error *error)
{
    static const char *const stages[] = {"volume/volume_slice.vert", "volume/volume_slice.frag", NULL};
    *slice = (VolumeSlice){.program = 0};
    if (!color_table_create(&slice->colors, view_colormap(def), &def->color_curve, error))
        return false;
    glCreateVertexArrays(1, &slice->vertex_array);
    slice->program = program_create("volume slice", stages, voxelizer_defines(voxelizer), error);
    return slice->program != 0;
}

static void volume_slice_destroy(VolumeSlice *slice)
{
    glDeleteProgram(slice->program);
    glDeleteVertexArrays(1, &slice->vertex_array);
    color_table_destroy(&slice->colors);
    *slice = (VolumeSlice){0};
}

/* Draws the def's slice into frame->target, colour and depth. The volume must be bound. */
static void volume_slice_draw(VolumeSlice *slice, const double box_size[3], const Frame *frame)
{
    const VolumeDef *def = volume_def(frame->def);
    const int axis = def->slice_axis;
    const double from = axis == 1 ? 0 : -box_size[axis] / 2;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glUseProgram(slice->program);
    glUniform1ui(SLICE_AXIS_AT, (GLuint)axis);
    glUniform1f(SLICE_PLACE_AT, (float)(from + def->slice * box_size[axis]));
    color_table_bind(&slice->colors, &frame->def->color_curve);
    glBindVertexArray(slice->vertex_array);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

typedef struct VolumeView {
    Voxelizer *voxelizer;
    VolumeWalls walls;  /* for looks that are surfaces */
    SolidShares shares; /* likewise, with solids */
    VolumeSlice slice;  /* if shown alone, all below is empty */
    Raycast *raycast;   /* NULL: the view shows the slice */
    ShadowCaster casting;
    Voxelizer *tint[FLUID_PARTS - 1]; /* carry green and blue of more than two fluids, else NULL */
    Voxelizer *opacity;   /* carries the scalar of opacity if not the colours' scalar; else NULL */
    SolidVoxels *solids;  /* NULL: no solids, or solids drawn as surfaces */
    FluidNumbers numbers; /* zero unless the volume carries fluids */
} VolumeView;

static void destroy(void *state)
{
    VolumeView *view = state;
    volume_walls_destroy(&view->walls);
    solid_shares_destroy(&view->shares);
    volume_slice_destroy(&view->slice);
    raycast_destroy(view->raycast);
    solid_voxels_destroy(view->solids);
    fluid_numbers_destroy(&view->numbers);
    shadow_caster_destroy(&view->casting);
    voxelizer_destroy(view->voxelizer);
    voxelizer_destroy(view->opacity);
    for (int i = 0; i < FLUID_PARTS - 1; i++)
        voxelizer_destroy(view->tint[i]);
    free(view);
}

static ParticleBuffers space_of(const WorldDef *world)
{
    ParticleBuffers space = {.spacing = world->spacing, .support_radius = world->support * world->spacing};
    memcpy(space.box_size, world->box_size, sizeof space.box_size);
    return space;
}

/* Rejects settings that no driver can draw. Limits of the present driver are found when the view is made. */
static bool check(const Subject *subject, const char **key, Error *error)
{
    const ParticleBuffers space = space_of(subject->world);
    const VolumeDef *def = volume_def(subject->def);
    VolumeGrid grid;
    *key = "view.volume.surface";
    if (volume_surface(subject->def) != VOLUME_RAYS && def->method == VOLUME_DIRECT)
        return error_set(error,
                         "a mesh is made of a volume, which view.volume.method: direct has not; use auto");
    *key = def->cell > 0 ? "view.volume.cell" : "view.volume.cells";
    return volume_grid_for(def, &space, &grid, error);
}

static bool has_room(Voxelizer *voxelizer, const VolumeDef *def, const ParticleBuffers *space,
                     const VolumeGrid *grid, Error *error)
{
    return voxelizer_fits(voxelizer, grid, space->support_radius, error) &&
           voxelizer_prepare(voxelizer, def, grid, error);
}

/* Far less than a quarter of the cubes are at a surface. */
static bool has_room_for_mesh(const ViewDef *def, const VolumeGrid *grid, Error *error)
{
    const size_t room = 4 * surface_mesh_capacity(grid);
    if (volume_surface(def) == VOLUME_RAYS || volume_grid_cells(grid) <= room)
        return true;
    return error_set(
        error,
        "the mesh of a volume of %zu cells needs a larger buffer than this driver has: at most %zu cells; use fewer or view.volume.surface: rays",
        volume_grid_cells(grid), room);
}

/* Checks the volume of the whole box: the fluid's volume may grow to that size. */
static bool accepts(void *state, const Subject *subject, Error *error)
{
    VolumeView *view = state;
    const ParticleBuffers space = space_of(subject->world);
    const VolumeDef *def = volume_def(subject->def);
    VolumeGrid grid;
    if (!(space.spacing > 0))
        return true;
    return volume_grid_for(def, &space, &grid, error) &&
           has_room(view->voxelizer, def, &space, &grid, error) &&
           has_room_for_mesh(subject->def, &grid, error) &&
           (!view->tint[0] || has_room(view->tint[0], def, &space, &grid, error)) &&
           (!view->tint[1] || has_room(view->tint[1], def, &space, &grid, error)) &&
           (!view->opacity || has_room(view->opacity, def, &space, &grid, error));
}

static bool create_raycast(VolumeView *view, const Subject *subject, Error *error)
{
    view->raycast = raycast_create(subject, view->voxelizer, error);
    const bool surface = volume_def(subject->def)->raycast.look != RAYCAST_TRANSLUCENT;
    return view->raycast && shadow_caster_create(&view->casting, NULL, error) &&
           (!surface || volume_walls_create(&view->walls, error)) &&
           (!surface || subject->world->solid_count == 0 || solid_shares_create(&view->shares, error));
}

/* The volume carries fluids if the picture shows the colours of several fluids, and a scalar if the
   picture shows a scalar's colours. */
static bool carries_fluids(const Subject *subject)
{
    return volume_def(subject->def)->show == VOLUME_SHADED && view_color_by(subject->def) == SCALAR_FLUID &&
           subject->world->fluid_count > 1;
}

static bool carries(const Subject *subject)
{
    return volume_def(subject->def)->show == VOLUME_SHADED &&
           (view_color_by(subject->def) != SCALAR_FLUID || carries_fluids(subject));
}

static bool create_tints(VolumeView *view, const Subject *subject, Error *error)
{
    for (int i = 0; volume_is_tinted(subject) && i < FLUID_PARTS - 1; i++) {
        view->tint[i] = voxelizer_create(volume_def(subject->def)->method, true, error);
        if (!view->tint[i])
            return false;
    }
    return true;
}

/* Always sampled as a texture, even if the field is not. */
static bool create_opacity(VolumeView *view, const ViewDef *def, Error *error)
{
    const VolumeMethod method = volume_def(def)->method;
    if (volume_opacity(def) != VOLUME_BY_OWN)
        return true;
    view->opacity = voxelizer_create(method == VOLUME_DIRECT ? VOLUME_AUTO : method, true, error);
    return view->opacity != NULL;
}

static bool create_solids(VolumeView *view, const Subject *subject, Error *error)
{
    if (volume_def(subject->def)->solids != VOLUME_SOLIDS_VOXELS || subject->world->solid_count == 0)
        return true;
    view->solids = solid_voxels_create(error);
    return view->solids != NULL;
}

static void *create(const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    VolumeView *view = calloc(1, sizeof *view);
    if (!view) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    view->voxelizer = voxelizer_create(volume_def(def)->method, carries(subject), error);
    const bool slice = volume_def(def)->show == VOLUME_SLICE;
    if (view->voxelizer && create_tints(view, subject, error) && create_opacity(view, def, error) &&
        create_solids(view, subject, error) && accepts(view, subject, error) &&
        (!carries_fluids(subject) || fluid_numbers_create(&view->numbers, error)) &&
        (slice ? volume_slice_create(&view->slice, def, view->voxelizer, error)
               : create_raycast(view, subject, error)))
        return view;
    destroy(view);
    return NULL;
}

/* A slice casts no shadow; fluid casts the shadow of its particles. */
static void cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    const VolumeView *view = state;
    (void)frame;
    if (view->raycast)
        shadow_caster_draw(&view->casting, particles);
}

/* A volume with the fluids' numbers, or a part of their colours. */
static bool make_part(VolumeView *view, int part, const ParticleBuffers *particles, const Frame *frame,
                      Volume *volume)
{
    Voxelizer *voxelizer = part > 0 ? view->tint[part - 1] : view->voxelizer;
    float of_fluid[FLUIDS_MAX] = {0};
    Error error;
    for (int i = 0; i < frame->world->fluid_count; i++)
        of_fluid[i] = view->tint[0] ? frame->world->fluids[i].color[part] : (float)i;
    const ParticleBuffers carrying =
        view->numbers.program ? fluid_numbers_add(&view->numbers, part, of_fluid, particles) : *particles;
    voxelizer_set_solids(voxelizer, view->shares.program ? &view->shares : NULL);
    if (!voxelizer_run(voxelizer, volume_def(frame->def), &carrying, view_color_by(frame->def), volume,
                       &error))
        return false;
    if (view->walls.program)
        volume_walls_apply(&view->walls, particles, frame->world->periodic, volume);
    return true;
}

static bool make_volume(VolumeView *view, const ParticleBuffers *particles, const Frame *frame,
                        Volume *volume)
{
    const ViewDef *def = frame->def;
    Error error;
    Volume opacity = {.field = 0}, tint[FLUID_PARTS - 1] = {0};
    if (view->opacity && !voxelizer_run(view->opacity, volume_def(def), particles,
                                        scalar_of_curve(&def->opacity), &opacity, &error))
        return false;
    if (view->shares.program)
        solid_shares_place(&view->shares, particles, frame->world);
    for (int i = 0; view->tint[0] && i < FLUID_PARTS - 1; i++)
        if (!make_part(view, i + 1, particles, frame, &tint[i]))
            return false;
    if (!make_part(view, 0, particles, frame, volume))
        return false;
    for (int i = 0; i < FLUID_PARTS - 1; i++)
        volume->tint[i] = tint[i].scalar;
    volume->opacity[0] = opacity.field;
    volume->opacity[1] = opacity.scalar;
    return true;
}

/* Uses cells of the box's volume, even if the fluid's volume covers only a part. */
static void draw_solids(VolumeView *view, const ParticleBuffers *particles, const Frame *frame)
{
    VolumeGrid grid;
    Error error;
    if (view->solids && volume_grid_for(volume_def(frame->def), particles, &grid, &error))
        GL_STAGE(frame->timer, STAGE_SOLIDS)
        {
            solid_voxels_draw(view->solids, grid.cell, particles, frame);
        }
}

static const char *missing(const void *state)
{
    return solid_voxels_missing(((const VolumeView *)state)->solids);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    VolumeView *view = state;
    Volume volume;
    bool made = false;
    draw_solids(view, particles, frame);
    GL_STAGE(frame->timer, STAGE_VOXELIZE)
    {
        made = make_volume(view, particles, frame, &volume);
    }
    if (!made) /* memory that was there at the start may be gone */
        return;
    if (view->raycast) {
        raycast_draw(view->raycast, &volume, view->voxelizer, particles, frame);
        return;
    }
    GL_STAGE(frame->timer, STAGE_SHADE)
    {
        voxelizer_bind(view->voxelizer);
        volume_slice_draw(&view->slice, particles->box_size, frame);
    }
}

/* Water in a scalar's colours would not look like water. */
static bool own_colors(const ViewDef *def)
{
    return volume_def(def)->raycast.look == RAYCAST_WATER;
}

/* The field is 1 in a fluid at rest, more in compressed fluid; raycast.frag shows up to 64 steps. */
static void show(const ViewDef *def, Frame *frame)
{
    const bool steps = volume_def(def)->show == VOLUME_STEPS;
    frame->fluid.clear = volume_def(def)->show == VOLUME_SHADED && own_colors(def) ? CLEAR_FLUID_LIGHT : 0;
    frame->no_solids = volume_def(def)->solids == VOLUME_SOLIDS_VOXELS;
    frame->fluid.refraction = (float)volume_def(def)->raycast.ior;
    if (volume_opacity(def) == VOLUME_EVEN)
        frame->curves.drawn = 0;
    if (!steps && volume_def(def)->show != VOLUME_SLICE)
        return;
    frame->colors.by_fluid = false;
    frame->colors.name = steps ? "steps" : "field";
    frame->colors.unit = "";
    frame->colors.range[0] = 0;
    frame->colors.range[1] = steps ? 64 : 1.25;
    frame->colors.beyond[0] = frame->colors.beyond[1] = false;
}

/* Values are those where rays show the fluid: in translucent fluid, where half the background is hidden. */
static ViewProbing probing(const void *state, const ViewDef *def)
{
    (void)state;
    return (ViewProbing){.by = volume_def(def)->show == VOLUME_SHADED ? VIEW_PROBE_MEAN : VIEW_PROBE_NOTHING};
}

/* True if volume and shaders carry the same colours and opacities. */
static bool same(const Subject *a, const Subject *b)
{
    return volume_opacity(a->def) == volume_opacity(b->def) &&
           raycast_is_curved(a->def) == raycast_is_curved(b->def) &&
           raycast_is_full(a->def) == raycast_is_full(b->def) &&
           (view_color_by(a->def) == SCALAR_FLUID) == (view_color_by(b->def) == SCALAR_FLUID) &&
           (a->world->fluid_count > 1) == (b->world->fluid_count > 1) &&
           volume_is_tinted(a) == volume_is_tinted(b);
}

/* Surfaces in a draft: shadow map instead of marching to the light, and cells twice as wide. Best: twice
   the cells along each axis, as far as more cells show more. */
static void quality(ViewDef *def, ViewQuality wanted)
{
    VolumeDef *own = volume_def(def);
    const VolumeDef *usual = &volume_usual;
    const bool draft = wanted == VIEW_DRAFT, surface = own->raycast.look != RAYCAST_TRANSLUCENT;
    if (own->cell == usual->cell && own->cells == usual->cells) {
        own->cells = draft ? usual->cells / 2 : 2 * usual->cells;
        own->cells_least = draft ? 0 : usual->cells;
    }
    if (draft && surface && own->raycast.shadows == usual->raycast.shadows)
        own->raycast.shadows = false;
    if (draft && def->resolution == 1)
        def->resolution = 0.5;
}

const ViewKind view_volume = {
    .name = "volume",
    .help = "the fluid's field on a grid of voxels, by raycasting: a surface, or translucent",
    .radius = 0.5,
    .curves = VIEW_OPACITY,
    .curves_where = &translucent,
    .own_colors = own_colors,
    .quality = quality,
    .create = create,
    .destroy = destroy,
    .keys = volume_keys,
    .grades = volume_grades,
    .def = &volume_usual,
    .def_size = sizeof volume_usual,
    .check = check,
    .same = same,
    .accepts = accepts,
    .show = show,
    .cast = cast,
    .draw = draw,
    .missing = missing,
    .probing = probing,
};
