/* Files of snapshots for the tests of playback: of a small tank, or made up. */
#ifndef SLOSH_RECORDED_FIXTURE_H
#define SLOSH_RECORDED_FIXTURE_H

#include "tests/app/output_fixture.h"

#include "app/run/offscreen.h"
#include "app/run/playback/playback.h"

#include <math.h>

static const char tank[] =
    "title: \"A \\\"tank\\\": 2\"\n"
    "box: {size: [1, 1, 1]}\n"
    "particles: {spacing: 0.1}\n"
    "fluids:\n"
    "  - {name: water, fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.5, 0.5]}}]}\n"
    "  - {name: oil, density: 900, fill: [{block: {min: [0, 0, -0.5], max: [0.5, 0.3, 0.5]}}]}\n"
    "solids:\n"
    "  - {sphere: {centre: [0.1, 0.7, 0], radius: 0.13}, motion: [{rock: {axis: [1, 0, 0], angle: 20, frequency: 1}}]}\n"
    "solver: {sound_speed: 15, threads: 1, step: {mode: fixed, dt: 0.01, substeps: 5}}\n"
    "motion: [{rock: {axis: [0, 0, 1], angle: 10, frequency: 1}}]\n"
    "view: {range: [0, 0.123456789], splat: {level: 0.3}}\n";

/* Of a group of tests: an OpenGL context in *state. */
static inline int context_begin(void **state)
{
    Error error = {{0}};
    *state = headless_create(HEADLESS_GPU_AUTO, &error);
    return *state ? 0 : -1;
}

static inline int context_end(void **state)
{
    headless_destroy(*state);
    return 0;
}

static inline void must(bool ok, const Error *error)
{
    if (!ok)
        fail_msg("%s", error->message);
}

static inline Scene tank_scene(const char *setting)
{
    Error error = {{0}};
    Scene scene;
    SceneSettings settings = {.count = setting ? 1 : 0, .set = {setting}};
    must(scene_parse("tank.yaml", tank, strlen(tank), &settings, &scene, NULL, &error), &error);
    return scene;
}

/* A step of so many particles on a line, at rest. */
static inline SnapshotStep made_up(size_t count, double time)
{
    SnapshotStep step;
    assert_true(snapshot_step_allocate(&step, count));
    step.time = time;
    step.step = (uint64_t)(1000 * time);
    step.box.orientation[3] = 1;
    for (size_t i = 0; i < count; i++) {
        step.position[0][i] = (float)(0.9 * (double)(i + 1) / (double)(count + 1) - 0.45);
        step.position[1][i] = 0.1F;
        step.density[i] = 1000;
        step.id[i] = (int64_t)i;
    }
    return step;
}

static inline void append(SnapshotWriter *file, size_t count, double time)
{
    Error error = {{0}};
    SnapshotStep step = made_up(count, time);
    must(snapshot_append_step(file, &step, &error), &error);
    snapshot_step_free(&step);
}

/* Steps of so many particles each, `interval` seconds apart. */
static inline void write_file(const char *path, const size_t counts[], size_t steps, double interval)
{
    Error error = {{0}};
    const Scene scene = tank_scene(NULL);
    SnapshotWriter *file = snapshot_create(path, &scene, &error);
    must(file, &error);
    for (size_t k = 0; k < steps; k++)
        append(file, counts[k], interval * (double)k);
    snapshot_close(file);
}

static inline void open_recorded(Recorded *recorded, const char *path, Notes *notes)
{
    Error error = {{0}};
    must(recorded_open(path, NULL, recorded, notes, &error), &error);
}

#endif
