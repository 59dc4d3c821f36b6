#include "render/volume/volume_def.h"

#include "render/particles/casting.h"
#include "render/volume/fluid_numbers.h"
#include "render/volume/raycast.h"
#include "render/volume/volume_slice.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

typedef struct VolumeView {
    Voxelizer *voxelizer;
    VolumeSlice slice; /* shown alone: nothing below is there */
    Raycast *raycast;  /* NULL: the slice */
    Casting casting;
    FluidNumbers numbers; /* where the volume carries fluids; else zero */
} VolumeView;

static void destroy(void *state)
{
    VolumeView *view = state;
    volume_slice_destroy(&view->slice);
    raycast_destroy(view->raycast);
    fluid_numbers_destroy(&view->numbers);
    casting_destroy(&view->casting);
    voxelizer_destroy(view->voxelizer);
    free(view);
}

static ParticleBuffers space_of(const WorldDef *world)
{
    ParticleBuffers space = {.spacing = world->spacing, .support_radius = world->support * world->spacing};
    memcpy(space.box_size, world->box_size, sizeof space.box_size);
    return space;
}

/* What no driver could draw. What the present driver cannot draw is found when the view is made. */
static bool check(const Subject *subject, const char **key, Error *error)
{
    const ParticleBuffers space = space_of(subject->world);
    const VolumeDef *def = volume_def(subject->def);
    VolumeGrid grid;
    *key = def->cell > 0 ? "view.volume.cell" : "view.volume.cells";
    return volume_grid_for(def, &space, &grid, error);
}

/* The box's volume: what the fluid's may become. */
static bool accepts(void *state, const Subject *subject, Error *error)
{
    VolumeView *view = state;
    const ParticleBuffers space = space_of(subject->world);
    const VolumeDef *def = volume_def(subject->def);
    VolumeGrid grid;
    if (!(space.spacing > 0))
        return true;
    return volume_grid_for(def, &space, &grid, error) &&
           voxelizer_fits(view->voxelizer, &grid, space.support_radius, error) &&
           voxelizer_prepare(view->voxelizer, def, &grid, error);
}

static bool create_raycast(VolumeView *view, const Subject *subject, Error *error)
{
    view->raycast = raycast_create(subject, view->voxelizer, error);
    return view->raycast && casting_create(&view->casting, NULL, error);
}

/* The volume carries the fluids where the picture has the colours of several, and a scalar where it has that
 * scalar's colours. */
static bool carries_fluids(const Subject *subject)
{
    return volume_def(subject->def)->show == VOLUME_SHADED && subject->def->color_by == SCALAR_FLUID &&
           subject->world->fluid_count > 1;
}

static bool carries(const Subject *subject)
{
    return volume_def(subject->def)->show == VOLUME_SHADED &&
           (subject->def->color_by != SCALAR_FLUID || carries_fluids(subject));
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
    if (view->voxelizer && accepts(view, subject, error) &&
        (!carries_fluids(subject) || fluid_numbers_create(&view->numbers, error)) &&
        (slice ? volume_slice_create(&view->slice, def, view->voxelizer, error)
               : create_raycast(view, subject, error)))
        return view;
    destroy(view);
    return NULL;
}

/* A slice of the field casts none; the fluid does as its particles do. */
static void cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    const VolumeView *view = state;
    (void)frame;
    if (view->raycast)
        casting_draw(&view->casting, particles);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    VolumeView *view = state;
    Volume volume;
    Error error;
    bool made = false;
    GL_STAGE(frame->timer, STAGE_VOXELIZE)
    {
        const ParticleBuffers carrying =
            view->numbers.program ? fluid_numbers_add(&view->numbers, particles) : *particles;
        made = voxelizer_run(view->voxelizer, volume_def(frame->def), &carrying, frame->def->color_by,
                             &volume, &error);
    }
    if (!made) /* memory that was there at the start is not there now */
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

/* The field is 1 in a fluid at rest, more where it is compressed; of steps raycast.frag shows 64. */
static void show(const ViewDef *def, Frame *frame)
{
    const bool steps = volume_def(def)->show == VOLUME_STEPS;
    if (!steps && volume_def(def)->show != VOLUME_SLICE)
        return;
    frame->by_fluid = false;
    frame->shown = steps ? "steps" : "field";
    frame->shown_unit = "";
    frame->range[0] = 0;
    frame->range[1] = steps ? 64 : 1.25;
    frame->beyond[0] = frame->beyond[1] = false;
}

/* Which colours volume and shaders carry. */
static bool same(const Subject *a, const Subject *b)
{
    return (a->def->color_by == SCALAR_FLUID) == (b->def->color_by == SCALAR_FLUID) &&
           (a->world->fluid_count > 1) == (b->world->fluid_count > 1);
}

const ViewKind view_volume = {
    .name = "volume",
    .help = "the fluid's field on a grid of voxels, by raycasting: a surface, or translucent",
    .radius = 0.5,
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
};
