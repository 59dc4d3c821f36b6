/* Worlds: steps, messages, figures, forces, probes, changes. */
#include "slosh/world.h"
#include "library/library.h"
#include "sim/base/base.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ROUNDING = 1e-6; /* of a frame: times are sums of decimal fractions */

static bool no_world(slosh_error *error)
{
    return library_refuse(error, "the world is NULL");
}

/* ---- messages ---- */

static void tell(void *user, const char *words)
{
    const slosh_world *world = user;
    if (world->tell)
        world->tell(world->user, words);
}

static void tell_notes(slosh_world *world)
{
    for (int i = 0; world->tell && i < world->notes.count; i++)
        tell(world, world->notes.line[i]);
    if (world->tell)
        world->notes.count = 0;
}

void slosh_world_on_message(slosh_world *world, slosh_tell *function, void *user)
{
    if (!world)
        return;
    world->tell = function;
    world->user = user;
    tell_notes(world);
}

/* ---- make and step ---- */

static bool on_cpu(const WorldDef *def, Error *error)
{
    return strcmp(def->backend, "cpu") == 0 ||
           error_set(error,
                     "solver.backend: %s computes on a GPU, and the library's worlds on the CPU; set "
                     "solver.backend=cpu",
                     def->backend);
}

static bool begin(slosh_world *world, Error *error)
{
    Run *run = &world->run;
    run->watch.closed = true;
    if (!on_cpu(&run->scene.world, error) || !run_begin(run, &run->scene.world, error))
        return false;
    if (run->scene.probes.count > 0 && !run_open_probes(run))
        return error_set(error, "no memory for the probes");
    return !run->probes.wants_forces || world_enable_forces(run->world, error);
}

slosh_world *slosh_world_create(const slosh_scene *scene, slosh_error *error)
{
    Error why = {"out of memory"};
    slosh_world *world = scene ? calloc(1, sizeof *world) : NULL;
    if (!scene)
        library_refuse(error, "the scene is NULL");
    if (!world)
        return library_fail(scene ? error : NULL, &why), NULL;
    world->run.scene = scene->scene;
    world->notes = scene->notes;
    world->state = 1;
    if (begin(world, &why))
        return world;
    slosh_world_destroy(world);
    return library_fail(error, &why), NULL;
}

void slosh_world_destroy(slosh_world *world)
{
    if (!world)
        return;
    run_close_probes(&world->run);
    world_destroy(world->run.world);
    library_columns_free(world);
    free(world->settings);
    free(world);
}

bool slosh_world_substep(slosh_world *world, slosh_error *error)
{
    Error why = {{0}};
    if (!world)
        return no_world(error);
    const bool ok = run_substep(&world->run, NULL, tell, world, &why);
    library_changed(world);
    return ok || library_fail(error, &why);
}

bool slosh_world_step(slosh_world *world, slosh_error *error)
{
    bool ok;
    do
        ok = slosh_world_substep(world, error);
    while (ok && world->run.info.within_frame);
    return ok;
}

bool slosh_world_run(slosh_world *world, double time, slosh_error *error)
{
    if (!world)
        return no_world(error);
    if (!isfinite(time))
        return library_refuse(error, "a run must end at a finite time");
    while (world->run.info.time < time - ROUNDING * world->run.scene.world.dt) {
        world_stop_at(world->run.world, time);
        if (!slosh_world_step(world, error))
            return false;
    }
    return true;
}

/* ---- figures ---- */

double slosh_world_time(const slosh_world *world)
{
    return world ? world->run.info.time : 0;
}

uint64_t slosh_world_steps(const slosh_world *world)
{
    return world ? world->run.info.step : 0;
}

size_t slosh_world_count(const slosh_world *world)
{
    return world ? world->run.info.count : 0;
}

int slosh_world_dimensions(const slosh_world *world)
{
    return world ? world->run.scene.world.dimensions : 0;
}

double slosh_world_dt(const slosh_world *world)
{
    return world ? world->run.info.dt : 0;
}

double slosh_world_spacing(const slosh_world *world)
{
    return world ? world->run.info.spacing : 0;
}

double slosh_world_support_radius(const slosh_world *world)
{
    return world ? world->run.info.support_radius : 0;
}

static void copy(double *to, const double *from, size_t count)
{
    for (size_t k = 0; to && k < count; k++)
        to[k] = from ? from[k] : 0;
}

void slosh_world_box_size(const slosh_world *world, double size[3])
{
    copy(size, world ? world->run.info.box_size : NULL, 3);
}

void slosh_world_gravity(const slosh_world *world, double g[3])
{
    copy(g, world ? world->run.info.gravity : NULL, 3);
}

void slosh_world_box(const slosh_world *world, double position[3], double orientation[4])
{
    copy(position, world ? world->run.info.box.position : NULL, 3);
    copy(orientation, world ? world->run.info.box.orientation : NULL, 4);
}

const char *slosh_world_outcome(slosh_world *world)
{
    Outcome outcome;
    if (!world)
        return NULL;
    if (!fluid_watch_outcome(&world->run.watch, &world->run.info.trouble, &outcome))
        return "not run";
    return outcome_text(&outcome, world->outcome);
}

uint64_t slosh_world_hash(slosh_world *world)
{
    return world ? world_hash(world->run.world) : 0;
}

const char *slosh_world_settings(slosh_world *world)
{
    if (!world)
        return NULL;
    free(world->settings);
    return world->settings = library_settings(&world->run.scene);
}

/* ---- forces ---- */

bool slosh_world_watch_forces(slosh_world *world, slosh_error *error)
{
    Error why = {{0}};
    if (!world)
        return no_world(error);
    if (!world->watches_forces && !world->run.probes.wants_forces &&
        !world_enable_forces(world->run.world, &why))
        return library_fail(error, &why);
    world->watches_forces = true;
    return true;
}

/* Adds the solver's sums to those of each reader. */
static void gather_forces(slosh_world *world)
{
    Forces mean;
    world_forces(world->run.world, &mean);
    if (mean.seconds <= 0)
        return;
    for (int k = 0; world->watches_forces && k <= SOLIDS_MAX; k++)
        forces_add_mean(&world->of_body[k], &mean);
    forces_add_mean(&world->of_probes, &mean);
}

int slosh_world_solid_count(const slosh_world *world)
{
    return world ? world->run.scene.world.solid_count : 0;
}

double slosh_world_force(slosh_world *world, int body, double force[3], double torque[3], slosh_error *error)
{
    if (!slosh_world_watch_forces(world, error))
        return -1;
    if (body < -1 || body >= slosh_world_solid_count(world)) {
        library_refuse(error, "there is no solid %d; the scene has %d, counted from 0, and the box is -1",
                       body, slosh_world_solid_count(world));
        return -1;
    }
    gather_forces(world);
    Forces *own = &world->of_body[body + 1];
    forces_mean(own);
    const Push *push = body < 0 ? &own->box : &own->solid[body];
    const double seconds = own->seconds;
    copy(force, push->force, 3);
    copy(torque, push->torque, 3);
    *own = (Forces){0};
    return seconds;
}

/* ---- probes ---- */

size_t slosh_world_probe_count(const slosh_world *world)
{
    return world && world->run.probes.probes ? (size_t)probes_columns(world->run.probes.probes) : 0;
}

const char *slosh_world_probe_name(const slosh_world *world, size_t index)
{
    return index < slosh_world_probe_count(world) ? probes_column(world->run.probes.probes, (int)index)->name
                                                  : NULL;
}

const char *slosh_world_probe_unit(const slosh_world *world, size_t index)
{
    return index < slosh_world_probe_count(world) ? probes_column(world->run.probes.probes, (int)index)->unit
                                                  : NULL;
}

bool slosh_world_read_probes(slosh_world *world, double values[], size_t count, slosh_error *error)
{
    if (!world)
        return no_world(error);
    RunProbes *own = &world->run.probes;
    if (count != slosh_world_probe_count(world) || (count > 0 && !values))
        return library_refuse(error, "the probes have %zu columns, and there is room for %zu",
                              slosh_world_probe_count(world), values ? count : 0);
    if (count == 0)
        return true;
    if (!cloud_read(&own->cloud, world->run.world))
        return library_refuse(error, "no memory to read the probes");
    if (own->wants_forces)
        gather_forces(world);
    forces_mean(&world->of_probes);
    probes_read(own->probes, &own->cloud, &world->of_probes, own->value);
    world->of_probes = (Forces){0};
    for (size_t i = 0; i < count; i++)
        values[i] = (double)own->value[i];
    return true;
}

/* ---- changes ---- */

static bool apply(slosh_world *world, const SimCommand *command, slosh_error *error)
{
    Error why = {{0}};
    library_lock(); /* a setting may read a file */
    const bool ok = run_apply(&world->run, command, &why);
    library_unlock();
    if (ok)
        world->run.watch.closed = false;
    library_changed(world);
    return ok || library_fail(error, &why);
}

bool slosh_world_set(slosh_world *world, const char *setting, slosh_error *error)
{
    SimCommand command = {.kind = SIM_SET};
    char path[SIM_SETTING_SIZE];
    if (!world)
        return no_world(error);
    if (!setting || !strchr(setting, '='))
        return library_refuse(error, "%s: a setting must be a text path=value", setting ? setting : "NULL");
    if (snprintf(command.setting, sizeof command.setting, "%s", setting) >= (int)sizeof command.setting)
        return library_refuse(error, "%.60s...: a change has at most %d bytes", setting,
                              SIM_SETTING_SIZE - 1);
    if (sim_command_needs_gpu(&command))
        return library_refuse(error, "%s: computes on a GPU, and the library's worlds on the CPU", setting);
    if (!apply(world, &command, error))
        return false;
    sim_command_path(&command, path);
    library_lock();
    scene_advise_key(&world->run.scene, path, &world->notes);
    library_unlock();
    tell_notes(world);
    return true;
}

static bool target_of(const double position[3], const double orientation[4], BoxTarget *target,
                      slosh_error *error)
{
    static const double upright[4] = {0, 0, 0, 1};
    const double *turn = orientation ? orientation : upright;
    double norm2 = 0;
    bool finite = position;
    for (int k = 0; finite && k < 3; k++)
        finite = isfinite(target->position[k] = position[k]);
    for (int k = 0; k < 4; k++)
        norm2 += turn[k] * turn[k];
    if (!finite || !isfinite(norm2) || norm2 < 1e-12)
        return library_refuse(error, "the box needs a position of three finite numbers, and an orientation "
                                     "that is a quaternion x y z w other than 0");
    for (int k = 0; k < 4; k++)
        target->orientation[k] = turn[k] / sqrt(norm2);
    return true;
}

static bool pose_box(slosh_world *world, SimCommandKind kind, const double position[3],
                     const double orientation[4], slosh_error *error)
{
    SimCommand command = {.kind = kind};
    if (!world)
        return no_world(error);
    return target_of(position, orientation, &command.target, error) && apply(world, &command, error);
}

bool slosh_world_move_box(slosh_world *world, const double position[3], const double orientation[4],
                          slosh_error *error)
{
    return pose_box(world, SIM_TARGET, position, orientation, error);
}

bool slosh_world_carry_box(slosh_world *world, const double position[3], const double orientation[4],
                           slosh_error *error)
{
    return pose_box(world, SIM_CARRY, position, orientation, error);
}
