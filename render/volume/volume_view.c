#include "render/volume/volume_def.h"

#include "render/particles/casting.h"
#include "render/volume/fluid_numbers.h"
#include "render/volume/raycast.h"
#include "render/volume/solid_voxels.h"
#include "render/volume/volume_slice.h"
#include "render/volume/walls.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

typedef struct VolumeView {
    Voxelizer *voxelizer;
    VolumeWalls walls; /* for looks that are surfaces */
    VolumeSlice slice; /* if shown alone, all below is empty */
    Raycast *raycast;  /* NULL: the view shows the slice */
    Casting casting;
    Voxelizer *opacity;   /* carries the scalar of opacity if not the colours' scalar; else NULL */
    SolidVoxels *solids;  /* NULL: no solids, or solids drawn as surfaces */
    FluidNumbers numbers; /* zero unless the volume carries fluids */
} VolumeView;

static void destroy(void *state)
{
    VolumeView *view = state;
    volume_walls_destroy(&view->walls);
    volume_slice_destroy(&view->slice);
    raycast_destroy(view->raycast);
    solid_voxels_destroy(view->solids);
    fluid_numbers_destroy(&view->numbers);
    casting_destroy(&view->casting);
    voxelizer_destroy(view->voxelizer);
    voxelizer_destroy(view->opacity);
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
    *key = def->cell > 0 ? "view.volume.cell" : "view.volume.cells";
    return volume_grid_for(def, &space, &grid, error);
}

static bool has_room(Voxelizer *voxelizer, const VolumeDef *def, const ParticleBuffers *space,
                     const VolumeGrid *grid, Error *error)
{
    return voxelizer_fits(voxelizer, grid, space->support_radius, error) &&
           voxelizer_prepare(voxelizer, def, grid, error);
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
           (!view->opacity || has_room(view->opacity, def, &space, &grid, error));
}

static bool create_raycast(VolumeView *view, const Subject *subject, Error *error)
{
    view->raycast = raycast_create(subject, view->voxelizer, error);
    const bool surface = volume_def(subject->def)->raycast.look != RAYCAST_TRANSLUCENT;
    return view->raycast && casting_create(&view->casting, NULL, error) &&
           (!surface || volume_walls_create(&view->walls, error));
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
    if (view->voxelizer && create_opacity(view, def, error) && create_solids(view, subject, error) &&
        accepts(view, subject, error) &&
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
        casting_draw(&view->casting, particles);
}

static bool make_volume(VolumeView *view, const ParticleBuffers *particles, const Frame *frame,
                        Volume *volume)
{
    const ViewDef *def = frame->def;
    Error error;
    Volume opacity = {.field = 0};
    const ParticleBuffers carrying =
        view->numbers.program ? fluid_numbers_add(&view->numbers, particles) : *particles;
    if (view->opacity && !voxelizer_run(view->opacity, volume_def(def), particles,
                                        scalar_of_curve(&def->opacity), &opacity, &error))
        return false;
    if (!voxelizer_run(view->voxelizer, volume_def(def), &carrying, view_color_by(def), volume, &error))
        return false;
    if (view->walls.program)
        volume_walls_mirror(&view->walls, particles, frame->world->periodic, volume);
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

static const char *lacks(const void *state)
{
    return solid_voxels_lacks(((const VolumeView *)state)->solids);
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
    frame->clear = volume_def(def)->show == VOLUME_SHADED && own_colors(def) ? CLEAR_FLUID_LIGHT : 0;
    frame->no_solids = volume_def(def)->solids == VOLUME_SOLIDS_VOXELS;
    frame->refraction = (float)volume_def(def)->raycast.ior;
    if (volume_opacity(def) == VOLUME_EVEN)
        frame->curves = 0;
    if (!steps && volume_def(def)->show != VOLUME_SLICE)
        return;
    frame->by_fluid = false;
    frame->shown = steps ? "steps" : "field";
    frame->shown_unit = "";
    frame->range[0] = 0;
    frame->range[1] = steps ? 64 : 1.25;
    frame->beyond[0] = frame->beyond[1] = false;
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
           raycast_is_whole(a->def) == raycast_is_whole(b->def) &&
           (view_color_by(a->def) == SCALAR_FLUID) == (view_color_by(b->def) == SCALAR_FLUID) &&
           (a->world->fluid_count > 1) == (b->world->fluid_count > 1);
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

static const KeyOwner translucent = {.key = "view.volume.look", .value = "translucent"};

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
    .lacks = lacks,
    .probing = probing,
};
