/* The field F = sum V W of a fluid (sim/mesh/field.h) and the means of scalars on a grid. On the CPU: reads
   the particles, which a software driver has in the CPU's memory. In a scene of two dimensions F is the
   plane's, the same all through the depth of the box. */
#ifndef SLOSH_FLUID_FIELD_H
#define SLOSH_FLUID_FIELD_H

#include "sim/gl/particle_buffers.h"
#include "sim/mesh/field.h"

enum { FLUID_MEANS_MAX = 9 };

/* Zero-initialise it. */
typedef struct FluidField {
    VolumeGrid grid;
    double side[3];  /* of a cell, m: not the grid's cell along z in two dimensions */
    double enlarged; /* 1; more: cells are so many times as large as asked for */
    float *field;    /* F */
    int means;
    Scalar scalar[FLUID_MEANS_MAX]; /* of which there are */
    float *mean[FLUID_MEANS_MAX];   /* sum V W s / F, of particles where s is a number; no number where only
                                       others are, 0 where F is 0 */
    /* what it is made with */
    FieldSlabs slabs;
    size_t count;                  /* of the particles that count */
    float *position, *raw, *value; /* 4 of each of them; as they were read; the scalar of each */
    float *known;                  /* F of the particles that have a number, where some have none */
    uint32_t *kept;                /* which of all they are */
    size_t sizes[4], cells, known_cells, mean_cells[FLUID_MEANS_MAX]; /* what there is room for */
} FluidField;

typedef struct FluidFieldJob {
    const ParticleBuffers *particles;
    double cell; /* side of a cell, m */
    double flat; /* depth of the box of a scene of two dimensions, m; else 0 */
    int means;
    Scalar scalar[FLUID_MEANS_MAX]; /* SCALAR_FLUID: the number of the fluid; one that is not there is 0 */
} FluidFieldJob;

/* The grid holds all fluid in the box, and a value or more without any around it. Where cells would be more
   than 2^27 they are as large as need be. False when memory is short. */
bool fluid_field_make(FluidField *fluid, const FluidFieldJob *job, Error *error);

/* The place of a value of the grid, or between values: m. */
void fluid_field_place(const FluidField *fluid, const double index[3], double place[3]);

/* The particles that the field is of, with their values of a scalar; until the next call of this or of
   fluid_field_make. */
void fluid_field_particles(FluidField *fluid, const ParticleBuffers *particles, Scalar scalar,
                           FieldParticles *out);

/* The mean of that scalar; NULL where there is none. */
const float *fluid_field_mean(const FluidField *fluid, Scalar scalar);

void fluid_field_free(FluidField *fluid); /* a zeroed one is allowed */

#endif
