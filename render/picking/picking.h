/* The particle, position or value that a user points at in a picture. Needs a current OpenGL 4.5 core
   context. */
#ifndef RENDER_PICKING_PICKING_H
#define RENDER_PICKING_PICKING_H

#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "sim/gpu/particle_buffers.h"

/* The particle under the mouse. */

/* Finds the first particle whose ball of `radius` (m) meets the ray; without a hit, the particle nearest
   to the ray within three radii. Returns false if there is no such particle or the state has no ids. Reads
   all positions back and waits for the GPU: for clicks, not for each picture. Needs the context. */
bool pick_particle(const ParticleBuffers *particles, const SightRay *ray, double radius, uint32_t *id);

/* As pick_particle, but gives the particle's position (box's frame, m); no ids are needed. */
bool pick_position(const ParticleBuffers *particles, const SightRay *ray, double radius, double at[3]);

/* Finds the particles or values of a picture at positions: under the mouse, by the picture's depth, and at
   given positions. Computed on the GPU and read once done: nothing waits.

   Needs a current OpenGL 4.5 core context. */

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
typedef struct ProbeRequest {
    ViewProbeRequest asks;
    uint64_t number;
    ViewProbing how;
    bool by_fluid, has_id;
    const char *name, *unit;
} ProbeRequest;

enum { PROBE_STAND_INS = 3 };

/* Zero-initialise. */
typedef struct ParticleProbe {
    unsigned place, sum[2], find;             /* programs; sum[1]: with radii */
    int kernel;                               /* kernel of `sum` */
    unsigned parts, nothing[PROBE_STAND_INS]; /* buffers */
    size_t capacity;                          /* capacity of `parts` */
    Mailbox mailbox;
    bool failed; /* a shader does not compile, or memory is short: gives no values */
    ProbeRequest sent, known;
    ProbeAnswer answers[VIEW_PROBES_MAX]; /* answers to `known` */
} ParticleProbe;

/* The values of a renderer's last picture under the mouse and at positions: from the view's own probe, or
   else from a ParticleProbe.

   Needs a current OpenGL 4.5 core context. */

/* Zero-initialise. */
typedef struct PictureProbe {
    bool drawn;            /* `picture` is valid: */
    ProbedPicture picture; /* all but `how` */
    ParticleProbe particles;
} PictureProbe;

/* Call after drawing a picture; buffers and target must stay valid until the next picture, or until
   picture_probe_clear. */
void picture_probe_set(PictureProbe *probe, const ParticleBuffers *particles, const Frame *frame,
                       unsigned uniforms);

/* Forgets the picture: destroyed, or different from the next picture. */
void picture_probe_clear(PictureProbe *probe);
void picture_probe_destroy(PictureProbe *probe);

/* True if a pixel, from the left and the top, may have a value. */
bool picture_probe_can(const PictureProbe *probe, const View *view, const ViewDef *def,
                       const double pixel[2]);

/* Asks without waiting. Returns false if the view has no values. */
bool picture_probe_request(PictureProbe *probe, View *view, const ViewDef *def, const ViewProbeRequest *asks,
                           ViewProbeAnswers *out);

#endif
