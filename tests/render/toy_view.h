/* A view in a single file: fills the picture's particle area with a shade, and registers in the list. */
#ifndef SLOSH_TESTS_TOY_VIEW_H
#define SLOSH_TESTS_TOY_VIEW_H

#include "render/frame/view.h"
#include "sim/base/base.h"
#include "sim/base/key_rows.h"

#include <epoxy/gl.h>
#include <stdlib.h>

typedef struct MAY_ALIAS ToyDef {
    double shade; /* 0 black, 1 white */
} ToyDef;

static const ViewKind view_toy;

static inline ToyDef *toy_def(const ViewDef *def)
{
    return view_own_settings(def, &view_toy);
}

static void *toy_create(const Subject *subject, Error *error)
{
    (void)subject, (void)error;
    return malloc(1); /* stateless */
}

static void toy_draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    (void)state, (void)particles;
    const float shade = (float)toy_def(frame->def)->shade;
    frame_set_scissor(frame);
    glClearNamedFramebufferfv(frame->target->framebuffer, GL_COLOR, 0, (float[4]){shade, shade, shade, 1});
    glDisable(GL_SCISSOR_TEST);
}

static const ToyDef toy_usual = {.shade = 0.5};
static const Key toy_keys[] = {
    MAPPING("view.toy", "of the view toy"),
    NUMBER("view.toy.shade", KEY_LIVE, "", 0, 1, offsetof(ToyDef, shade), "from black to white"),
    KEYS_END,
};
static const ViewKind view_toy = {.name = "toy",
                                  .help = "one shade for all of the fluid",
                                  .keys = toy_keys,
                                  .def = &toy_usual,
                                  .def_size = sizeof toy_usual,
                                  .create = toy_create,
                                  .destroy = free,
                                  .draw = toy_draw};
/* Before the first scene is read. */
static void toy_view_add(void)
{
    view_add(&view_toy);
}

#endif
