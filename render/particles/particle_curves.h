/* Size and opacity of particles by a scalar, through a curve of control points (ViewDef.size,
   ViewDef.opacity). One pass over the particles for each curve of a def, none without curves.

   Sizes are radii for shaders with DROPS (shaders/common/ball.glsl). Opacity is the share of a particle's
   pixels that the particle covers, by a screen-door per particle (shaders/common/veil.glsl). Nothing is
   sorted, and covered pixels are opaque; many particles behind each other look blended. The screen-door
   stands still while the particle's id and the pixels do. */
#ifndef SLOSH_PARTICLE_CURVES_H
#define SLOSH_PARTICLE_CURVES_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

typedef struct ParticleCurve {
    unsigned program; /* 0: the def has no such curve */
    unsigned values;  /* buffer: size: a float per particle, m; opacity: two floats, the opacity and the
                         start of the particle's screen-door */
    size_t capacity;  /* particles */
} ParticleCurve;

typedef struct ParticleCurves {
    ParticleCurve size, opacity;
} ParticleCurves;

/* The defines for shaders that read the values: DROPS, VEILED. Static string. */
const char *particle_curves_defines(const ViewDef *def);

/* The largest factor of a radius over these particles. */
double particle_curves_reach(const ViewDef *def, const ParticleBuffers *particles);

/* Returns false if a shader does not compile; call particle_curves_destroy in either case. */
bool particle_curves_create(ParticleCurves *curves, const ViewDef *def, Error *error);
void particle_curves_destroy(ParticleCurves *curves);

/* Computes sizes and opacities of these particles, from the frame's def and ranges. Particles without the
   scalar keep the size and opacity of a def without curves. A NaN scalar counts as the high end of the
   range. */
void particle_curves_make(ParticleCurves *curves, const ParticleBuffers *particles, const Frame *frame);

/* Sets the uniforms of shaders/common/curve.glsl in the program in use: the curve over `range`, y in units
   of `unit`. If not `there`, the curve is 1. */
void particle_curve_set(const ScalarCurve *said, const double range[2], double unit, bool there);

/* Runs a variant of shaders/render/particle_curve.comp over all particles, into the buffers that the
   caller has bound. The curve's y is in units of `unit`. */
void particle_curve_run(unsigned program, const ScalarCurve *said, const double range[2], double unit,
                        const ParticleBuffers *particles);

/* Binds sizes and opacities for shaders. */
void particle_curves_bind(const ParticleCurves *curves);

#endif
