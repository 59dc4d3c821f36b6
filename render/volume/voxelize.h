/* Interface of the voxelization methods; for render/volume/voxelizer.c and tests. The block of
   shaders/volume/volume_block.h is bound during a run. */
#ifndef SLOSH_VOXELIZE_H
#define SLOSH_VOXELIZE_H

#include "render/volume/volume.h"

typedef struct VoxelizeJob {
    const ParticleBuffers *particles;
    Scalar carried;
    bool scalar;            /* a scalar is carried */
    double low[3], high[3]; /* bounds of the particles that count, m */
    double radius;          /* h, cells */
    double amplitude;       /* W(0), 1/m3 (1/m2 in the plane): a particle's field at its centre per volume */
    const Volume *volume;   /* result; textures hold the last run's values, or 0 everywhere */
} VoxelizeJob;

typedef struct VoxelizeMethod {
    /* Returns a method's state, or NULL with the reason. */
    void *(*create)(VolumeMethod method, bool scalar, Error *error);
    void (*destroy)(void *state);
    bool (*fits)(const VolumeGrid *grid, double radius, Error *error); /* NULL: anything that fits a
                                                                          texture */
    /* Allocates the memory that such volumes need beside the textures. NULL: none. */
    bool (*reserve)(void *state, const VolumeGrid *grid, Error *error);
    bool (*run)(void *state, const VoxelizeJob *job, Error *error);
} VoxelizeMethod;

extern const VoxelizeMethod voxelize_points;  /* geometry, layers, planes */
extern const VoxelizeMethod voxelize_compute; /* scatter, gather, direct */
extern const VoxelizeMethod voxelize_slabs;

/* As voxelize_points.create and voxelize_compute.create, without features that some drivers lack: one draw
   per layer instead of gl_Layer in a vertex shader, exchanges of bits instead of float atomics. */
void *voxelize_points_plain(VolumeMethod method, bool scalar, Error *error);
void *voxelize_compute_plain(VolumeMethod method, bool scalar, Error *error);

/* Binds the lists of a voxelize_compute state. */
void voxelize_compute_bind(const void *state);

/* Creates a texture for a volume, 0 everywhere; the caller deletes the texture. Returns 0 if memory is
   short. */
unsigned volume_texture(const int size[3], unsigned format, const char *label);

#endif
