/* slosh info FILE of particles: a recorded run, or a foreign file. */
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/run/playback/playback.h"
#include "sim/world.h"

#include <stdio.h>

static void put_scalars(const Recorded *recorded, bool quiet, json_t *list)
{
    if (!quiet)
        printf("scalars\n ");
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (recorded->attributes & PARTICLE_SCALAR(s)) {
            if (!quiet)
                printf(" %s", scalar_name((Scalar)s));
            json_array_append_new(list, json_string(scalar_name((Scalar)s)));
        }
    if (!quiet)
        printf("\n");
}

static void print(const Recorded *recorded, size_t particles, const Notes *notes)
{
    const SnapshotScene *numbers = &recorded->numbers;
    printf("%s\n  %s, %zu step%s from %.9g s to %.9g s, %zu particle%s in the last one\n", recorded->path,
           recorded->foreign ? "of another program" : "of slosh run", recorded->steps,
           plural(recorded->steps), recorded->first, recorded->last, particles, plural(particles));
    printf("  box %.6g x %.6g x %.6g m, spacing %.6g m, support radius %.6g m, %zu fluid%s\n",
           numbers->box_size[0], numbers->box_size[1], numbers->box_size[2], numbers->spacing,
           numbers->support_radius, numbers->fluid_count, plural(numbers->fluid_count));
    for (int i = 0; i < notes->count; i++)
        printf("  %s\n", notes->line[i]);
}

static json_t *summary(const Recorded *recorded, size_t particles, const Notes *notes)
{
    const SnapshotScene *numbers = &recorded->numbers;
    json_t *lines = json_array();
    for (int i = 0; i < notes->count; i++)
        json_array_append_new(lines, json_string(notes->line[i]));
    return json_pack("{s:s, s:s, s:s, s:b, s:I, s:f, s:f, s:I, s:[f,f,f], s:f, s:f, s:I, s:o}", "command",
                     "info", "version", SLOSH_VERSION, "file", recorded->path, "foreign", recorded->foreign,
                     "steps", (json_int_t)recorded->steps, "first_seconds", recorded->first, "last_seconds",
                     recorded->last, "particles", (json_int_t)particles, "box_size", numbers->box_size[0],
                     numbers->box_size[1], numbers->box_size[2], "spacing", numbers->spacing,
                     "support_radius", numbers->support_radius, "fluids", (json_int_t)numbers->fluid_count,
                     "notes", lines);
}

int info_file(const Args *args)
{
    Error error = {{0}};
    Notes notes = {.count = 0};
    Recorded recorded;
    StateCopy state = {.capacity = 0};
    if (!recorded_open(args->scenes[0], &args->settings, &recorded, &notes, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    bool ok = recorded_read(&recorded, recorded.steps - 1, 0, &state, &error);
    if (ok && !args->quiet)
        print(&recorded, state.state.count, &notes);
    json_t *json = ok ? summary(&recorded, state.state.count, &notes) : NULL, *scalars = json_array();
    if (ok)
        put_scalars(&recorded, args->quiet, scalars);
    json_object_set_new(json, "scalars", scalars);
    ok = ok && (!args->json || json_file_write(json, args->json, &error));
    json_decref(json);
    state_copy_free(&state);
    recorded_close(&recorded);
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    return ok ? 0 : EXIT_FAILED;
}
