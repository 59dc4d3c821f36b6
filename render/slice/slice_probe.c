#include "render/slice/slice_probe.h"

#include "shaders/slice/slice_bindings.h"

#include <math.h>
#include <string.h>

_Static_assert((int)VIEW_PROBES_MAX <= (int)PLANE_PROBES_MAX, "all that may be asked of a view has room");

/* `samples`: position on the rectangle, in samples. Returns the distance from the plane, m. */
static double on_plane(const PlaneJob *job, const double at[3], double samples[2])
{
    const Plane *plane = &job->plane;
    double away = 0;
    samples[0] = samples[1] = 0;
    for (int k = 0; k < 3; k++) {
        const double from = at[k] - plane->corner[k];
        samples[0] += from * plane->along[k] * job->samples[0] / plane->size[0];
        samples[1] += from * plane->up[k] * job->samples[1] / plane->size[1];
        away += from * plane->normal[k];
    }
    return fabs(away);
}

static void place_of(const Plane *plane, const double share[2], double at[3])
{
    for (int k = 0; k < 3; k++)
        at[k] = plane->corner[k] + share[0] * plane->size[0] * plane->along[k] +
                share[1] * plane->size[1] * plane->up[k];
}

bool slice_probe_pick(const SliceProbe *probe, const double pixel[2], double at[3])
{
    const int *part = probe->part;
    double samples[2];
    SightRay ray;
    if (!probe->drawn)
        return false;
    if (probe->flat)
        place_of(&probe->job.plane,
                 (const double[2]){(pixel[0] - part[0]) / part[2],
                                   (probe->sight.height - pixel[1] - part[1]) / part[3]},
                 at);
    else {
        sight_ray(&probe->sight, pixel, &ray);
        if (!sight_ray_plane(&ray, probe->job.plane.corner, probe->job.plane.normal, at))
            return false;
    }
    on_plane(&probe->job, at, samples);
    return samples[0] >= 0 && samples[0] < probe->job.samples[0] && samples[1] >= 0 &&
           samples[1] < probe->job.samples[1];
}

static bool pixel_of(const SliceProbe *probe, const double at[3], double pixel[2])
{
    const int *part = probe->part;
    double samples[2];
    if (!probe->flat)
        return sight_pixel(&probe->sight, at, pixel);
    on_plane(&probe->job, at, samples);
    pixel[0] = part[0] + samples[0] * part[2] / probe->job.samples[0];
    pixel[1] = probe->sight.height - (part[1] + samples[1] * part[3] / probe->job.samples[1]);
    return true;
}

/* The sample at a position; -1, -1 outside the rectangle, or if the position is more than half a sample
   off the plane. */
static void sample_of(const PlaneJob *job, const double at[3], int sample[2])
{
    double samples[2];
    const double side = fmax(job->plane.size[0] / job->samples[0], job->plane.size[1] / job->samples[1]);
    bool off = on_plane(job, at, samples) > side / 2;
    for (int k = 0; k < 2; k++)
        off |= !(samples[k] >= 0 && samples[k] < job->samples[k]);
    for (int k = 0; k < 2; k++)
        sample[k] = off ? -1 : (int)samples[k];
}

static void answer(const SliceProbe *probe, int index, ViewProbe *out)
{
    const PlaneProbes *probes = &probe->probe.probes;
    const float *sums = probe->probe.sums[index];
    const double field = (double)sums[1] + sums[2];
    *out = (ViewProbe){
        .now = probes->run == probe->run, .name = probes->name, .unit = probes->unit, .id = VIEW_NO_ID};
    memcpy(out->at, probes->at[index], sizeof out->at);
    out->seen = pixel_of(probe, out->at, out->pixel);
    if (probes->sample[index][0] < 0)
        out->what = VIEW_PROBE_OFF;
    else if (plane_empty(sums) || field < probes->cut)
        out->what = VIEW_PROBE_EMPTY;
    else {
        out->value = probes->shown == SLICE_FIELD ? field : plane_value(sums, probes->shown == SLICE_RAW);
        out->what = isnan(out->value) ? VIEW_PROBE_NAN : VIEW_PROBE_VALUE;
    }
}

int slice_probe_read(SliceProbe *probe, const PlaneSum *sum, const double (*at)[3], int count, ViewProbe *out)
{
    PlaneProbes probes = {.count = count < PLANE_PROBES_MAX ? count : PLANE_PROBES_MAX,
                          .run = probe->run,
                          .shown = probe->shown,
                          .cut = probe->cut,
                          .name = probe->name,
                          .unit = probe->unit};
    if (!probe->drawn)
        return 0;
    for (int i = 0; i < probes.count; i++) {
        memcpy(probes.at[i], at[i], sizeof probes.at[i]);
        sample_of(&probe->job, at[i], probes.sample[i]);
    }
    plane_probe_ask(&probe->probe, sum, &probes);
    const int answered = probe->probe.probes.count;
    for (int i = 0; i < answered && i < probes.count; i++)
        answer(probe, i, &out[i]);
    return answered < probes.count ? answered : probes.count;
}
