#include "render/volume_view.h"

#include "render/volume_slice.h"

#include <stdlib.h>

typedef struct VolumeView {
    Voxelizer *voxelizer;
    VolumeSlice slice;
    Volume volume;
} VolumeView;

const Volume *volume_view_volume(const void *state)
{
    return &((const VolumeView *)state)->volume;
}

static void destroy(void *state)
{
    VolumeView *view = state;
    volume_slice_destroy(&view->slice);
    voxelizer_destroy(view->voxelizer);
    free(view);
}

/* The box's volume: what the fluid's may become. */
static bool accepts(void *state, const ViewDef *def, Error *error)
{
    const VolumeView *view = state;
    ParticleBuffers space = {.spacing = def->spacing, .support_radius = def->support_radius};
    VolumeGrid grid;
    for (int k = 0; k < 3; k++)
        space.box_size[k] = def->box_size[k];
    if (!(def->spacing > 0))
        return true;
    return volume_grid_for(&def->volume, &space, &grid, error) &&
           voxelizer_fits(view->voxelizer, &grid, def->support_radius, error);
}

static void *create(const ViewDef *def, Error *error)
{
    VolumeView *view = calloc(1, sizeof *view);
    if (!view) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    view->voxelizer = voxelizer_create(def->volume.method, false, error);
    if (view->voxelizer && accepts(view, def, error) &&
        volume_slice_create(&view->slice, def, view->voxelizer, error))
        return view;
    destroy(view);
    return NULL;
}

/* A slice of the field casts none. */
static void cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    (void)state, (void)particles, (void)frame;
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    VolumeView *view = state;
    Error error;
    bool made = false;
    GL_STAGE(frame->timer, STAGE_VOXELIZE)
    made = voxelizer_run(view->voxelizer, &frame->def->volume, particles, frame->def->color_by, &view->volume,
                         &error);
    if (!made) /* memory that was there at the start is not there now */
        return;
    GL_STAGE(frame->timer, STAGE_SHADE)
    {
        voxelizer_bind(view->voxelizer);
        volume_slice_draw(&view->slice, particles->box_size, frame);
    }
}

/* The field is 1 in a fluid at rest, more where it is compressed. */
static void show(const ViewDef *def, Frame *frame)
{
    (void)def;
    frame->by_fluid = false;
    frame->shown = "field";
    frame->shown_unit = "";
    frame->range[0] = 0;
    frame->range[1] = 1.25;
}

const ViewKind view_volume = {
    .name = "volume",
    .help = "the fluid's field on a grid of voxels",
    .radius = 0.5,
    .create = create,
    .destroy = destroy,
    .accepts = accepts,
    .show = show,
    .cast = cast,
    .draw = draw,
};
