#include "app/dist/forces.h"

#include "app/base/output.h"
#include "app/dist/share.h"

bool dist_forces_feel(const Stand *stand, const Args *args, Error *error)
{
    const Session *session = &stand->session;
    const bool feels = args->forces || (args->probes && probe_list_has_forces(&session->scene.probes));
    return !feels || world_feel(session->world, error);
}

bool dist_forces_check(const Stand *stand, const Args *args, Error *error)
{
    return dist_agree(stand->rank > 0 || !args->forces || output_check(args->forces, error), error);
}

bool dist_forces_begin(ForcesLog *log, const Stand *stand, const Args *args, bool resumed, Error *error)
{
    const Session *session = &stand->session;
    const double keep = resumed ? session->info.time : -1;
    return !args->forces ||
           dist_agree(stand->rank > 0 ||
                          forces_log_open(log, args->forces, session->scene.world.solid_count, keep, error),
                      error);
}

bool dist_forces_frame(ForcesLog *log, ProbeSeries *probes, Stand *stand, const Args *args, Error *error)
{
    Forces forces;
    bool ok = true;
    if (!args->forces)
        return true;
    probe_series_forces(probes, &stand->session, &forces);
    if (stand->rank == 0)
        ok = forces_log_add(log, stand->session.info.time, &forces, error);
    return dist_agree(ok, error);
}

bool dist_forces_end(ForcesLog *log, Error *error)
{
    return dist_agree(forces_log_close(log, error), error);
}
