#include "render/frame/view.h"

#include "render/spheres/spheres.h"
#include "render/splat/splat.h"
#include "render/volume/volume_view.h"
#include "sim/gl/limits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ViewKind *const view_list[] = {&view_spheres, &view_splat, &view_volume, NULL};

struct View {
    const ViewKind *kind;
    void *state;
};

const ViewKind *view_find(const char *name)
{
    for (int i = 0; view_list[i]; i++)
        if (strcmp(view_list[i]->name, name) == 0)
            return view_list[i];
    return NULL;
}

static void unknown_view(const char *name, Error *error)
{
    char known[256] = "";
    for (int i = 0; view_list[i]; i++)
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", i ? ", " : "",
                 view_list[i]->name);
    error_set(error, "unknown view \"%s\"; known are: %s", name, known);
}

/* Particles are drawn from storage blocks; common/particles.glsl, listed.glsl and ball.glsl have five. The
   largest is the ellipsoids', three vec4 each. */
static bool drawable(const ViewDef *def, Error *error)
{
    const bool ellipsoids = strcmp(def->kind, "splat") == 0 && def->splat.shape == SPLAT_ELLIPSOID;
    char who[NAME_SIZE + 32];
    snprintf(who, sizeof who, "view %s%s", def->kind, ellipsoids ? " of ellipsoids" : "");
    const GlLimits have = gl_limits();
    const GlNeeds needs = {.who = who,
                           .instead = "use another GPU or driver",
                           .least = {.vertex_blocks = 5,
                                     .bindings = 11,
                                     .block_bytes = (int64_t)def->particles * (ellipsoids ? 48 : 16)}};
    return gl_limits_allow(&have, &needs, error);
}

View *view_create(const ViewDef *def, Error *error)
{
    const ViewKind *kind = view_find(def->kind);
    if (!kind) {
        unknown_view(def->kind, error);
        return NULL;
    }
    if (!drawable(def, error))
        return NULL;
    View *view = malloc(sizeof *view);
    void *state = view ? kind->create(def, error) : NULL;
    if (!state) {
        free(view);
        return NULL;
    }
    *view = (View){kind, state};
    return view;
}

void view_destroy(View *view)
{
    if (!view)
        return;
    view->kind->destroy(view->state);
    free(view);
}

const ViewKind *view_kind(const View *view)
{
    return view->kind;
}

void view_prepare(View *view, const ParticleBuffers *particles, const Frame *frame)
{
    if (view->kind->prepare)
        view->kind->prepare(view->state, particles, frame);
}

bool view_accepts(View *view, const ViewDef *def, Error *error)
{
    return !view->kind->accepts || view->kind->accepts(view->state, def, error);
}

void view_show(const View *view, const ViewDef *def, Frame *frame)
{
    if (view->kind->show)
        view->kind->show(def, frame);
}

void view_cast(View *view, const ParticleBuffers *particles, const Frame *frame)
{
    view->kind->cast(view->state, particles, frame);
}

void view_draw(View *view, const ParticleBuffers *particles, const Frame *frame)
{
    view->kind->draw(view->state, particles, frame);
}
