/* What the particles of a picture are at places of it: under the mouse, whose place follows from the
   picture's depth, and at places that are said. Found on the GPU and there when that is done: nothing waits.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PARTICLE_PROBE_H
#define SLOSH_PARTICLE_PROBE_H

#include "render/frame/target.h"
#include "render/frame/view.h"
#include "sim/gl/mailbox.h"

/* A picture that was drawn. */
typedef struct ProbedPicture {
    ParticleBuffers particles; /* as its passes read them */
    Target target;             /* the renderer's */
    unsigned uniforms;         /* buffer: those of its frame */
    ViewProbing how;
    Scalar scalar;
    bool by_fluid;           /* it shows fluids in place of the scalar */
    int kernel;              /* of plane_kernels, for means */
    uint64_t number;         /* another where it may differ in anything from the one before */
    Sight sight;             /* reach is not used */
    const char *name, *unit; /* of what it shows; static */
    const WorldDef *world;   /* which has the fluids' names; up to the next answer */
} ProbedPicture;

/* Block Answers of shaders/render/probe.glsl. */
typedef struct ProbeAnswer {
    float place[4], own[4];
    float ratio;
    uint32_t who;
    float carried, field, lost;
    uint32_t fluid, id, unused;
} ProbeAnswer;

/* What is asked of a picture. */
typedef struct ProbeAsked {
    ViewAsks asks;
    uint64_t number;
    ViewProbing how;
    bool by_fluid, has_id;
    const char *name, *unit;
} ProbeAsked;

enum { PROBE_STAND_INS = 3 };

/* Zero-initialise it. */
typedef struct ParticleProbe {
    unsigned place, sum[2], find;             /* programs; sum[1]: with radii */
    int kernel;                               /* that sum is for */
    unsigned parts, nothing[PROBE_STAND_INS]; /* buffers */
    size_t capacity;                          /* parts */
    Mailbox mailbox;
    bool failed; /* a shader does not compile, or memory is short: it knows nothing */
    ProbeAsked sent, known;
    ProbeAnswer answers[VIEW_PROBES_MAX]; /* to `known` */
} ParticleProbe;

/* Asks, unless that is asked already, and takes what has come. False: nothing is known yet. */
bool particle_probe_ask(ParticleProbe *probe, const ProbedPicture *picture, const ViewAsks *asks,
                        ViewProbes *out);
void particle_probe_destroy(ParticleProbe *probe);

#endif
