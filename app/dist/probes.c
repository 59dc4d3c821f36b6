#include "app/dist/probes.h"

#include "app/dist/share.h"
#include "app/lab/probe_chart.h"
#include "sim/dist/dist.h"

bool dist_probes_check(const Stand *stand, const Args *args, Error *error)
{
    return dist_agree(stand->rank > 0 || run_probes_check(&stand->session, args, error), error);
}

bool dist_probes_check_table(const Stand *stand, const Args *args, bool resumed, Error *error)
{
    return dist_agree(stand->rank > 0 || run_probes_check_table(args, resumed, error), error);
}

bool dist_probes_begin(DistProbes *probes, Stand *stand, const Args *args, bool resumed, Error *error)
{
    const Scene *scene = &stand->session.scene;
    if (!args->probes)
        return true;
    probes->probes = probes_create(&scene->probes, &scene->world);
    if (!probes->probes)
        dist_die("no memory for the probes; use fewer of them");
    near_read(&probes->near, probes->probes, stand->session.world);
    probes->series.given = &probes->near.cloud;
    return dist_agree(
        stand->rank > 0 || run_probes_begin(&probes->series, &stand->session, args, resumed, error), error);
}

bool dist_probes_step(DistProbes *probes, const Stand *stand, Error *error)
{
    if (!probes->probes)
        return true;
    near_read(&probes->near, probes->probes, stand->session.world);
    return dist_agree(stand->rank > 0 || probe_series_step(&probes->series, &stand->session, error), error);
}

/* All ranks have already checked the step with world_sound; another check by a single rank is not
   collective. */
bool dist_probes_frame(DistProbes *probes, const Stand *stand, Error *error)
{
    return !probes->probes ||
           dist_agree(stand->rank > 0 || probe_series_frame(&probes->series, &stand->session, error), error);
}

bool dist_probes_end(DistProbes *probes, const Stand *stand, const Args *args, Error *error)
{
    bool ok = true;
    if (!probes->probes)
        return true;
    if (stand->rank == 0)
        ok = probe_series_close(&probes->series, error) &&
             run_probes_draw(&probes->series, &stand->session, args, error);
    return dist_agree(ok, error);
}

void dist_probes_free(DistProbes *probes)
{
    probe_series_free(&probes->series);
    near_free(&probes->near);
    probes_destroy(probes->probes);
    probes->probes = NULL;
}
