/* The values of a renderer's last picture under the mouse and at positions: from the view's own probe, or
   else from render/probe/particle_probe.h.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PICTURE_PROBE_H
#define SLOSH_PICTURE_PROBE_H

#include "render/probe/particle_probe.h"

/* Zero-initialise. */
typedef struct PictureProbe {
    bool drawn;            /* `picture` is valid: */
    ProbedPicture picture; /* all but `how` */
    ParticleProbe particles;
} PictureProbe;

/* Call after drawing a picture; buffers and target must stay valid until the next picture, or until
   picture_probe_forget. */
void picture_probe_drawn(PictureProbe *probe, const ParticleBuffers *particles, const Frame *frame,
                         unsigned uniforms);

/* Forgets the picture: destroyed, or different from the next picture. */
void picture_probe_forget(PictureProbe *probe);
void picture_probe_destroy(PictureProbe *probe);

/* True if a pixel, from the left and the top, may have a value. */
bool picture_probe_may(const PictureProbe *probe, const View *view, const ViewDef *def,
                       const double pixel[2]);

/* Asks without waiting. Returns false if the view has no values. */
bool picture_probe_ask(PictureProbe *probe, View *view, const ViewDef *def, const ViewAsks *asks,
                       ViewProbes *out);

#endif
