/* What the last picture of a renderer shows under the mouse and at places: asked of its view where that has a
   probe, else found by render/probe/particle_probe.h.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PICTURE_PROBE_H
#define SLOSH_PICTURE_PROBE_H

#include "render/probe/particle_probe.h"

/* Zero-initialise it. */
typedef struct PictureProbe {
    bool drawn;            /* there is one: */
    ProbedPicture picture; /* but for `how` */
    ParticleProbe particles;
} PictureProbe;

/* Behind a picture; buffers and target stay up to the next one, or to the next call of picture_probe_end. */
void picture_probe_drawn(PictureProbe *probe, const ParticleBuffers *particles, const Frame *frame,
                         unsigned uniforms);

/* The picture is gone, or is not what will be drawn. */
void picture_probe_forget(PictureProbe *probe);
void picture_probe_destroy(PictureProbe *probe);

/* Whether a value may be found at a pixel, from the left and the top. */
bool picture_probe_may(const PictureProbe *probe, const View *view, const ViewDef *def,
                       const double pixel[2]);

/* Without waiting. False: the view can tell of none. */
bool picture_probe_ask(PictureProbe *probe, View *view, const ViewDef *def, const ViewAsks *asks,
                       ViewProbes *out);

#endif
