/* What of particles goes with a scalar by a curve of control points (ViewDef.size, ViewDef.opacity): one pass
   over the particles for each that a def has, nothing where it has none.

   Sizes are radii for shaders with DROPS (shaders/common/ball.glsl). Opacities are shares of the pixels of a
   particle that it covers, by a screen-door of its own (shaders/common/veil.glsl): nothing is sorted, what is
   covered is whole, and many that lie one behind the other look as if they were blended. Such a door stands
   still where the particle's id and the picture's pixels do. */
#ifndef SLOSH_PARTICLE_CURVES_H
#define SLOSH_PARTICLE_CURVES_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

typedef struct ParticleCurve {
    unsigned program; /* 0: the def has no such curve */
    unsigned values;  /* buffer: a float each, m; of opacity two: it, and where the particle's door begins */
    size_t capacity;  /* particles */
} ParticleCurve;

typedef struct ParticleCurves {
    ParticleCurve size, opacity;
} ParticleCurves;

/* For shaders that read them: DROPS, VEILED. A constant. */
const char *particle_curves_defines(const ViewDef *def);

/* The greatest factor of a radius for these particles. */
double particle_curves_reach(const ViewDef *def, const ParticleBuffers *particles);

/* False when a shader does not compile; particle_curves_destroy is needed in either case. */
bool particle_curves_create(ParticleCurves *curves, const ViewDef *def, Error *error);
void particle_curves_destroy(ParticleCurves *curves);

/* Makes both for these particles, by the frame's def and ranges. Particles without the scalar are as large
   and as opaque as they would be without the curve; a scalar that is NaN counts as the high end of its
   range. */
void particle_curves_make(ParticleCurves *curves, const ParticleBuffers *particles, const Frame *frame);

/* Gives the program in use that curve over that range, its y in units of `unit`: shaders/common/curve.glsl.
   Where it is not `there` the curve is 1. */
void particle_curve_set(const ScalarCurve *said, const double range[2], double unit, bool there);

/* Runs a form of shaders/render/particle_curve.comp for that curve over all particles, into what the caller
   has bound; the curve's y count in units of `unit`. */
void particle_curve_run(unsigned program, const ScalarCurve *said, const double range[2], double unit,
                        const ParticleBuffers *particles);

/* Binds them for shaders. */
void particle_curves_bind(const ParticleCurves *curves);

#endif
