#include "app/dist/forces.h"

#include "app/base/output.h"
#include "app/dist/share.h"

#include <stdio.h>
#include <unistd.h>

static bool agree(bool ok, Error *error)
{
    return dist_share()->agree(ok, error);
}

bool dist_forces_feel(const Stand *stand, const Args *args, Error *error)
{
    const Session *session = &stand->session;
    const bool feels = args->forces || (args->probes && probe_list_feels(&session->scene.probes));
    return !feels || world_feel(session->world, error);
}

bool dist_forces_check(const Stand *stand, const Args *args, Error *error)
{
    return agree(stand->rank > 0 || !args->forces || output_check(args->forces, error), error);
}

static bool open_log(ForcesLog *log, const Session *session, const char *path, bool resumed, Error *error)
{
    if (resumed && access(path, F_OK) != 0)
        fprintf(stderr, "%s: there is no such table to go on with; it begins at t = %.4g s\n", path,
                session->info.time);
    return forces_log_open(log, path, session->scene.world.solid_count, resumed ? session->info.time : -1,
                           error);
}

bool dist_forces_begin(ForcesLog *log, const Stand *stand, const Args *args, bool resumed, Error *error)
{
    return !args->forces ||
           agree(stand->rank > 0 || open_log(log, &stand->session, args->forces, resumed, error), error);
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
    return agree(ok, error);
}

bool dist_forces_end(ForcesLog *log, Error *error)
{
    return agree(forces_log_close(log, error), error);
}
