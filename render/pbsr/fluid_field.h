/* The field F = sum V W of a fluid (sim/mesh/field.h) and means of scalars on a grid. Computed on the CPU
   from particles read back; on a software driver the particles are in CPU memory. In a two-dimensional
   scene F is the plane's field, constant through the depth of the box. */
#ifndef SLOSH_FLUID_FIELD_H
#define SLOSH_FLUID_FIELD_H

#include "sim/gl/particle_buffers.h"
#include "sim/mesh/field.h"

enum { FLUID_MEANS_MAX = 9 };

/* Zero-initialise. */
typedef struct FluidField {
    VolumeGrid grid;
    double side[3];  /* sides of a cell, m: in two dimensions not the grid's cell along z */
    double enlarged; /* cell size divided by the requested size, at least 1 */
    float *field;    /* F */
    int means;
    Scalar scalar[FLUID_MEANS_MAX]; /* the scalars of the means */
    float *mean[FLUID_MEANS_MAX];   /* sum V W s / F over particles with a number s; NaN if all particles
                                       there lack a number, 0 where F is 0 */
    /* work arrays */
    FieldSlabs slabs;
    size_t count;                  /* number of particles in the field */
    float *position, *raw, *value; /* 4 floats per particle in the field; raw data of all particles; scalar
                                      of each particle in the field */
    float *known;                  /* F of the particles with a number, if some lack a number */
    uint32_t *kept;                /* indices of the particles in the field */
    size_t sizes[4], cells, known_cells, mean_cells[FLUID_MEANS_MAX]; /* capacities */
} FluidField;

typedef struct FluidFieldJob {
    const ParticleBuffers *particles;
    double cell; /* side of a cell, m */
    double flat; /* depth of the box in a two-dimensional scene, m; else 0 */
    int means;
    Scalar scalar[FLUID_MEANS_MAX]; /* SCALAR_FLUID: the fluid's number; a missing scalar is 0 */
} FluidFieldJob;

/* The grid contains all fluid in the box, and at least one empty value around. Cells are enlarged if the
   grid would have more than 2^27. Returns false if memory is short. */
bool fluid_field_make(FluidField *fluid, const FluidFieldJob *job, Error *error);

/* The position of a value of the grid, or between values: m. */
void fluid_field_place(const FluidField *fluid, const double index[3], double place[3]);

/* The particles of the field with their values of a scalar; valid until the next call of this function or
   of fluid_field_make. */
void fluid_field_particles(FluidField *fluid, const ParticleBuffers *particles, Scalar scalar,
                           FieldParticles *out);

/* The mean of a scalar; NULL if there is none. */
const float *fluid_field_mean(const FluidField *fluid, Scalar scalar);

void fluid_field_free(FluidField *fluid); /* a zeroed struct is allowed */

#endif
