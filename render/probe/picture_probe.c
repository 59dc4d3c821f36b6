#include "render/probe/picture_probe.h"

#include "render/plane/plane_kernel.h"

#include <string.h>

static bool same_state(const ParticleBuffers *a, const ParticleBuffers *b)
{
    return a->step == b->step && a->time == b->time && a->count == b->count &&
           a->position.buffer == b->position.buffer && a->position.offset == b->position.offset;
}

static bool same_camera(const Camera *a, const Camera *b)
{
    bool same = a->near_plane == b->near_plane;
    for (int k = 0; k < 3; k++)
        same &= a->eye[k] == b->eye[k];
    for (int k = 0; k < 16; k++)
        same &= a->view[k] == b->view[k];
    for (int k = 0; k < 2; k++)
        same &= a->tangent[k] == b->tangent[k] && a->centre[k] == b->centre[k];
    return same;
}

static bool same_picture(const ProbedPicture *a, const ProbedPicture *b)
{
    return same_state(&a->particles, &b->particles) && a->target.number == b->target.number &&
           a->scalar == b->scalar && a->name == b->name && a->by_fluid == b->by_fluid &&
           same_camera(&a->sight.camera, &b->sight.camera);
}

void picture_probe_drawn(PictureProbe *probe, const ParticleBuffers *particles, const Frame *frame,
                         unsigned uniforms)
{
    const ProbedPicture now = {.particles = *particles,
                               .target = *frame->target,
                               .uniforms = uniforms,
                               .scalar = view_color_by(frame->def),
                               .by_fluid = frame->by_fluid,
                               .kernel = plane_kernel_of(0, frame->world),
                               .sight = {frame->camera, particles->box, frame->width, frame->height, 0},
                               .name = frame->by_fluid ? scalar_name(SCALAR_FLUID) : frame->shown,
                               .unit = frame->by_fluid ? "" : frame->shown_unit,
                               .world = frame->world};
    const uint64_t number = probe->picture.number;
    const bool same = probe->drawn && same_picture(&probe->picture, &now);
    probe->picture = now;
    probe->picture.number = same ? number : number + 1;
    probe->drawn = true;
}

void picture_probe_forget(PictureProbe *probe)
{
    probe->drawn = false;
}

void picture_probe_destroy(PictureProbe *probe)
{
    particle_probe_destroy(&probe->particles);
    *probe = (PictureProbe){.drawn = false};
}

bool picture_probe_may(const PictureProbe *probe, const View *view, const ViewDef *def, const double pixel[2])
{
    double at[3];
    if (!probe->drawn)
        return false;
    return view_kind(view)->probe ? view_pick(view, pixel, at)
                                  : view_probing(view, def).by != VIEW_PROBE_NOTHING;
}

static bool is_at(const ViewProbe *probe, const double at[3])
{
    return probe->at[0] == at[0] && probe->at[1] == at[1] && probe->at[2] == at[2];
}

/* For the mouse, asks for the position that the view shows at the pixel. */
static bool ask_view(View *view, const ViewAsks *asks, ViewProbes *out)
{
    double at[VIEW_PROBES_MAX][3];
    int count = asks->count;
    memcpy(at, asks->at, sizeof at);
    out->asked = true;
    out->placed = out->mouse = asks->mouse && view_pick(view, asks->pixel, at[count]);
    if (out->placed)
        memcpy(out->place, at[count], sizeof out->place);
    count += out->mouse;
    const int known = count ? view_probe(view, (const double(*)[3])at, count, out->probe) : 0;
    if (known < 0)
        return false;
    out->count = known;
    out->mouse &= known == count;
    out->now = known == count;
    for (int i = 0; i < known; i++)
        out->now &= out->probe[i].now && is_at(&out->probe[i], at[i]);
    return true;
}

bool picture_probe_ask(PictureProbe *probe, View *view, const ViewDef *def, const ViewAsks *asks,
                       ViewProbes *out)
{
    *out = (ViewProbes){.count = 0};
    if (!probe->drawn)
        return false;
    if (view_kind(view)->probe)
        return ask_view(view, asks, out);
    probe->picture.how = view_probing(view, def);
    if (probe->picture.how.by == VIEW_PROBE_NOTHING)
        return false;
    particle_probe_ask(&probe->particles, &probe->picture, asks, out);
    return true;
}
