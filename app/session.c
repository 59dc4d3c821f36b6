#include "app/session.h"

#include "app/json_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Times are sums and products of decimal fractions: a state this small part of a frame early is on time. */
static const double ROUNDING = 1e-6;

bool session_open(Session *session, const Args *args, Error *error)
{
    char note[256] = "";
    SceneSettings settings = args->settings;
    *session = (Session){.began_ms = wall_ms()};
    if (!scene_load(args->scenes[0], &settings, &session->scene, note, error))
        return false;
    if (note[0] && !args->quiet)
        fprintf(stderr, "%s\n", note);
    return session_start(session, error);
}

bool session_start(Session *session, Error *error)
{
    session->world = world_create(&session->scene.world, error);
    if (session->world)
        world_info(session->world, &session->info);
    return session->world != NULL;
}

void session_close(Session *session)
{
    world_destroy(session->world);
    session->world = NULL;
}

bool session_reached(const Session *session, double time)
{
    return session->info.time >= time - ROUNDING * session->scene.world.dt;
}

bool session_step(Session *session, Error *error)
{
    bool stepped = world_step(session->world, NULL, error);
    world_info(session->world, &session->info);
    return stepped;
}

bool session_substep(Session *session, Error *error)
{
    bool stepped = world_substep(session->world, NULL, error);
    world_info(session->world, &session->info);
    return stepped;
}

static double wall_seconds(const Session *session)
{
    return fmax((wall_ms() - session->began_ms) / 1000, 1e-6);
}

void session_report(const Session *session, const Args *args, const Summary *summary)
{
    const WorldInfo *info = &session->info;
    const double wall = wall_seconds(session);
    if (summary->stopped)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", info->time, args->output);
    if (!args->quiet)
        fprintf(stderr, "%zu particles, %.3g s simulated in %.3g s (%.3g times real time): %s, %zu %.*s\n",
                info->count, info->time, wall, info->time / wall, args->output, summary->products,
                (int)strlen(summary->product) - (summary->products == 1), summary->product);
}

static json_t *summary_json(const Session *session, const Args *args, const Summary *summary)
{
    const WorldInfo *info = &session->info;
    const WorldDef *def = &session->scene.world;
    const double wall = wall_seconds(session);
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:s, s:i, s:I, s:f, s:f, s:i, s:I, s:I, s:f, s:f, s:f, s:b}", "command",
        summary->command, "scene", session->scene.path, "output", args->output, "backend", def->backend,
        "method", def->method, "threads", info->threads, "particles", (json_int_t)info->count, "spacing",
        info->spacing, "dt", def->dt, "substeps", def->substeps, "steps", (json_int_t)info->step,
        summary->product, (json_int_t)summary->products, "simulated_seconds", info->time, "wall_seconds",
        wall, "real_time_factor", info->time / wall, "stopped", summary->stopped);
    if (json && summary->renderer)
        json_object_set_new(json, "renderer", json_string(summary->renderer));
    return json;
}

bool session_write_json(const Session *session, const Args *args, const Summary *summary, Error *error)
{
    if (!args->json)
        return true;
    json_t *json = summary_json(session, args, summary);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}
