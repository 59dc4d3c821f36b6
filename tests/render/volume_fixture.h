/* What the tests of volumes share: fixed particles, the voxels read back, and the same by brute force. */
#ifndef SLOSH_VOLUME_FIXTURE_H
#define SLOSH_VOLUME_FIXTURE_H

#include "tests/render/fixture.h"

#include "render/views/volume/volume_private.h"
#include "sim/kernel/kernel.h"

#include <epoxy/gl.h>

typedef struct VolumeScene {
    Particles *particles;
    ParticleBuffers state;
    VolumeDef def;
} VolumeScene;

/* A voxelizer's volume on this side. */
typedef struct Voxels {
    Volume volume;
    size_t count;
    float *field, *scalar; /* the latter NULL without */
} Voxels;

/* A box 2 x 1 x 1 m without particles, that far apart. */
static inline VolumeScene volume_scene(double spacing, int cells)
{
    VolumeScene scene = {calloc(1, sizeof(Particles)), box_state(0, spacing), volume_usual};
    assert_non_null(scene.particles);
    scene.def.cells = cells;
    return scene;
}

static inline void volume_scene_free(VolumeScene *scene)
{
    free(scene->particles);
}

static inline void add_volume(VolumeScene *scene, double x, double y, double z, double volume, double speed)
{
    particles_add(scene->particles, x, y, z, speed, 0);
    scene->particles->position[4 * scene->particles->count - 1] = (float)volume;
}

/* A block of fluid in a corner of the box, not quite a lattice, and a drop. */
static inline void add_fluid(VolumeScene *scene)
{
    const double d = scene->state.spacing;
    for (int i = 0; i < 6 * 5 * 7; i++) {
        const int x = i % 6, y = i / 6 % 5, z = i / 30;
        add_volume(scene, -1 + d * (x + 0.5 + 0.2 * sin(7.1 * i)), d * (y + 0.5 + 0.2 * sin(3.7 * i)),
                   -0.5 + d * (z + 0.5 + 0.2 * sin(5.3 * i)), d * d * d * (1 + 0.1 * sin(9.7 * i)),
                   1 + sin(i));
    }
    add_volume(scene, 0.613, 0.871, 0.262, d * d * d, 2.5);
}

static inline float *read_texture(GLuint texture, size_t count)
{
    float *values = malloc(count * sizeof *values);
    assert_non_null(values);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(texture, 0, GL_RED, GL_FLOAT, (GLsizei)(count * sizeof *values), values);
    return values;
}

static inline void voxels_free(Voxels *voxels)
{
    free(voxels->field);
    free(voxels->scalar);
}

static inline size_t voxel_count(const VolumeGrid *grid)
{
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

/* Runs the voxelizer on the scene as it is now. */
static inline Voxels voxelized(Voxelizer *voxelizer, VolumeScene *scene)
{
    Voxels voxels = {0};
    Error error = {0};
    ParticleBuffers buffers;
    scene->state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    if (!voxelizer_run(voxelizer, &scene->def, &buffers, SCALAR_SPEED, &voxels.volume, &error))
        fail_msg("%s", error.message);
    voxels.count = voxel_count(&voxels.volume.grid);
    voxels.field = voxels.volume.field ? read_texture(voxels.volume.field, voxels.count)
                                       : calloc(voxels.count, sizeof(float));
    assert_non_null(voxels.field);
    voxels.scalar = voxels.volume.scalar ? read_texture(voxels.volume.scalar, voxels.count) : NULL;
    glFinish();
    upload_destroy(upload);
    return voxels;
}

/* By all particles that have finite numbers, in double. */
static inline void brute_field(const VolumeScene *scene, const double at[3], double *field, double *scalar)
{
    *field = *scalar = 0;
    for (size_t i = 0; i < scene->particles->count; i++) {
        const float *p = &scene->particles->position[4 * i];
        const double d[3] = {p[0] - at[0], p[1] - at[1], p[2] - at[2]};
        const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double part =
            r < scene->state.support_radius ? p[3] * kernel_poly6(r, scene->state.support_radius) : 0;
        *field += part;
        *scalar += part * scene->particles->speed[i];
    }
}

static inline void voxel_centre(const VolumeGrid *grid, size_t voxel, double at[3])
{
    const size_t width = (size_t)grid->size[0], height = (size_t)grid->size[1];
    const size_t cell[3] = {voxel % width, voxel / width % height, voxel / width / height};
    for (int k = 0; k < 3; k++)
        at[k] = grid->corner[k] + grid->cell * ((double)cell[k] + 0.5);
}

static inline Voxels brute_voxels(const VolumeScene *scene, const VolumeGrid *grid)
{
    Voxels voxels = {.volume.grid = *grid, .count = voxel_count(grid)};
    voxels.field = malloc(voxels.count * sizeof(float));
    voxels.scalar = malloc(voxels.count * sizeof(float));
    assert_true(voxels.field && voxels.scalar);
    for (size_t i = 0; i < voxels.count; i++) {
        double at[3], field, scalar;
        voxel_centre(grid, i, at);
        brute_field(scene, at, &field, &scalar);
        voxels.field[i] = (float)field;
        voxels.scalar[i] = (float)scalar;
    }
    return voxels;
}

/* The greatest difference, as a share of the greatest of `wanted`; infinite where one is no number. */
static inline double worst_of(const float *values, const float *wanted, size_t count)
{
    double worst = 0, range = 0;
    for (size_t i = 0; i < count; i++) {
        const double off = fabs((double)values[i] - wanted[i]);
        worst = off <= worst ? worst : isnan(off) ? INFINITY : off;
        range = fmax(range, fabs((double)wanted[i]));
    }
    return worst / range;
}

static inline Voxelizer *voxelizer_of(VolumeMethod method, bool scalar)
{
    Error error = {0};
    Voxelizer *voxelizer = voxelizer_create(method, scalar, &error);
    if (!voxelizer)
        fail_msg("%s: %s", volume_method_names[method], error.message);
    return voxelizer;
}

#endif
