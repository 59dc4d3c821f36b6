/* What the methods of voxelization share; for render/volume/voxelizer.c and tests. The block of
   shaders/volume/volume_block.h is bound while they run. */
#ifndef SLOSH_VOXELIZE_H
#define SLOSH_VOXELIZE_H

#include "render/volume/volume.h"

typedef struct VoxelizeJob {
    const ParticleBuffers *particles;
    Scalar carried;
    bool scalar;            /* one is carried */
    double low[3], high[3]; /* where particles count, m */
    double radius;          /* h, cells */
    double amplitude; /* W(0), 1/m3 (1/m2 in the plane): what a particle adds at its centre, by its volume */
    const Volume *volume; /* to be filled; textures as they were left, or 0 everywhere */
} VoxelizeJob;

typedef struct VoxelizeMethod {
    /* The state of a method, or NULL with the reason. */
    void *(*create)(VolumeMethod method, bool scalar, Error *error);
    void (*destroy)(void *state);
    bool (*fits)(const VolumeGrid *grid, double radius, Error *error); /* NULL: whatever a texture takes */
    /* Takes the memory that such volumes need beside their textures. NULL: none. */
    bool (*reserve)(void *state, const VolumeGrid *grid, Error *error);
    bool (*run)(void *state, const VoxelizeJob *job, Error *error);
} VoxelizeMethod;

extern const VoxelizeMethod voxelize_points;  /* geometry, layers, planes */
extern const VoxelizeMethod voxelize_compute; /* scatter, gather, direct */
extern const VoxelizeMethod voxelize_slabs;

/* The same as voxelize_points.create and voxelize_compute.create without what some drivers lack: one draw a
   layer in place of gl_Layer in a vertex shader, exchanges of bits in place of float atomics. */
void *voxelize_points_plain(VolumeMethod method, bool scalar, Error *error);
void *voxelize_compute_plain(VolumeMethod method, bool scalar, Error *error);

/* Binds the lists of a state of voxelize_compute. */
void voxelize_compute_bind(const void *state);

/* A texture for a volume, 0 everywhere; the caller deletes it. 0 when memory is short. */
unsigned volume_texture(const int size[3], unsigned format, const char *label);

#endif
