/* Finds the particles or values of a picture at positions: under the mouse, by the picture's depth, and at
   given positions. Computed on the GPU and read once done: nothing waits.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PARTICLE_PROBE_H
#define SLOSH_PARTICLE_PROBE_H

#include "render/frame/target.h"
#include "render/frame/view.h"
#include "sim/gl/mailbox.h"

/* A drawn picture. */
typedef struct ProbedPicture {
    ParticleBuffers particles; /* as the passes read the particles */
    Target target;             /* the renderer's */
    unsigned uniforms;         /* buffer: uniforms of the picture's frame */
    ViewProbing how;
    Scalar scalar;
    bool by_fluid;           /* shows fluids instead of the scalar */
    int kernel;              /* index in plane_kernels, for means */
    uint64_t number;         /* changes whenever the picture may differ from the previous picture */
    Sight sight;             /* `reach` is not used */
    const char *name, *unit; /* name and unit of the value; static */
    const WorldDef *world;   /* for the fluids' names; must be valid until the next answer */
} ProbedPicture;

/* Block Answers of shaders/render/probe.glsl. */
typedef struct ProbeAnswer {
    float place[4], own[4];
    float ratio;
    uint32_t who;
    float carried, field, lost;
    uint32_t fluid, id, unused;
} ProbeAnswer;

/* A request for a picture. */
typedef struct ProbeAsked {
    ViewAsks asks;
    uint64_t number;
    ViewProbing how;
    bool by_fluid, has_id;
    const char *name, *unit;
} ProbeAsked;

enum { PROBE_STAND_INS = 3 };

/* Zero-initialise. */
typedef struct ParticleProbe {
    unsigned place, sum[2], find;             /* programs; sum[1]: with radii */
    int kernel;                               /* kernel of `sum` */
    unsigned parts, nothing[PROBE_STAND_INS]; /* buffers */
    size_t capacity;                          /* capacity of `parts` */
    Mailbox mailbox;
    bool failed; /* a shader does not compile, or memory is short: gives no values */
    ProbeAsked sent, known;
    ProbeAnswer answers[VIEW_PROBES_MAX]; /* answers to `known` */
} ParticleProbe;

/* Sends the request, unless already sent, and takes an answer that has arrived. Returns false if nothing
   is known yet. */
bool particle_probe_ask(ParticleProbe *probe, const ProbedPicture *picture, const ViewAsks *asks,
                        ViewProbes *out);
void particle_probe_destroy(ParticleProbe *probe);

#endif
