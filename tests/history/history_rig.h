/* A simulator with history, on a thread or on the GPU, driven frame by frame; the world is read while no
   frame is due. */
#ifndef SLOSH_HISTORY_RIG_H
#define SLOSH_HISTORY_RIG_H

#include "tests/app/output_fixture.h"
#include "tests/patience.h"

#include "app/run/offscreen.h"
#include "app/run/session.h"
#include "app/run/simulator_private.h"
#include "app/scene/scene.h"
#include "sim/flow/flow.h"
#include "sim/gpu/gl.h"
#include "sim/start/start.h"

#include <math.h>

static Headless *context;
static Error error;

typedef struct Rig {
    Scene scene;
    Recording recording;
    Upload *upload;
    Simulator *simulator;
    SimulatorStatus status;
    ParticleBuffers particles;
} Rig;

static inline void must(bool ok)
{
    if (!ok)
        fail_msg("%s", error.message);
}

/* `how`: what is not the rig's own. */
static inline void rig_start(Rig *rig, const char *text, SimulatorSetup how)
{
    SceneSettings settings = {.count = 0};
    *rig = (Rig){.upload = NULL};
    must(scene_parse("a.yaml", text, strlen(text), &settings, &rig->scene, NULL, &error));
    must(recording_create(&rig->recording, "a.yaml", text, strlen(text), &settings, &error));
    WorldDef could = rig->scene.world;
    could.pours = true; /* as compare_simulated_particles has it */
    rig->upload = upload_create(flow_capacity(&could, seed_count(&could, could.spacing)),
                                PARTICLE_SCALAR(SCALAR_SPEED), &error);
    how.scene = &rig->scene;
    how.recording = &rig->recording;
    how.upload = rig->upload;
    how.paused = true;
    rig->simulator = simulator_create(&how, &error);
    assert_non_null(rig->simulator);
}

static inline void rig_open(Rig *rig, const char *text, size_t history_bytes)
{
    rig_start(rig, text, (SimulatorSetup){.history_bytes = history_bytes});
}

static inline void rig_close(Rig *rig)
{
    assert_true(simulator_destroy(rig->simulator, PATIENCE_MS));
    upload_destroy(rig->upload);
    recording_destroy(&rig->recording);
}

/* One turn of the window's loop. */
static inline void rig_turn(Rig *rig)
{
    simulator_work(rig->simulator, 5);
    simulator_status(rig->simulator, &rig->status);
    if (!simulator_on_gpu(rig->simulator) && upload_has_new(rig->upload))
        assert_true(upload_take(rig->upload, &rig->particles));
    usleep(100);
}

static inline void rig_ready(Rig *rig)
{
    const double until = wall_ms() + PATIENCE_MS;
    do
        rig_turn(rig);
    while (!rig->status.ready && !rig->status.failed && wall_ms() < until);
    assert_true(rig->status.ready || rig->status.failed);
}

/* Advances to the end of a frame. */
static inline void rig_step(Rig *rig)
{
    const double until = wall_ms() + PATIENCE_MS;
    rig_turn(rig);
    const uint64_t frames = rig->status.frames;
    simulator_single_step(rig->simulator, false);
    do
        rig_turn(rig);
    while (rig->status.frames == frames && wall_ms() < until);
    assert_true(rig->status.frames == frames + 1);
}

/* Until nothing is left to do; paused. */
static inline void rig_rest(Rig *rig)
{
    const double until = wall_ms() + PATIENCE_MS;
    do
        rig_turn(rig);
    while (!rig->status.rests && wall_ms() < until);
    assert_true(rig->status.rests);
    rig_turn(rig);
}

/* Until the target is reached. */
static inline void rig_arrive(Rig *rig)
{
    const double until = wall_ms() + PATIENCE_MS;
    do
        rig_turn(rig);
    while (rig->status.timeline.travelling && wall_ms() < until);
    assert_false(rig->status.timeline.travelling);
}

static inline void rig_go(Rig *rig, double time)
{
    simulator_go_to(rig->simulator, time);
    rig_arrive(rig);
}

static inline void rig_back(Rig *rig)
{
    simulator_step_back(rig->simulator, false);
    rig_arrive(rig);
}

static inline void rig_set(Rig *rig, const char *setting)
{
    SimCommand set = {.kind = SIM_SET};
    snprintf(set.setting, sizeof set.setting, "%s", setting);
    assert_true(simulator_send(rig->simulator, &set) > 0);
}

static inline void rig_target(Rig *rig, double x)
{
    const SimCommand target = {.kind = SIM_TARGET, .target = {{x, 0, 0}, {0, 0, 0, 1}}};
    assert_true(simulator_send(rig->simulator, &target) > 0);
}

static inline void rig_carry(Rig *rig, double x)
{
    const SimCommand carry = {.kind = SIM_CARRY, .target = {{x, 0, 0}, {0, 0, 0, 1}}};
    assert_true(simulator_send(rig->simulator, &carry) > 0);
}

/* Of the present state, while nothing is due. */
static inline uint64_t rig_hash(Rig *rig)
{
    rig_turn(rig);
    return world_hash(rig->simulator->run.world);
}

static inline void rig_save(Rig *rig, const char *path)
{
    const double until = wall_ms() + PATIENCE_MS;
    rig_turn(rig);
    const unsigned saves = rig->status.saves;
    assert_true(simulator_save(rig->simulator, path));
    do
        rig_turn(rig);
    while (rig->status.saves == saves && wall_ms() < until);
    if (!rig->status.saved)
        fail_msg("%s", rig->status.save_message);
}

/* The recorded session, simulated again: the steps; the bits equal the recording's. */
static inline uint64_t replay(const char *path)
{
    static Session session;
    Recording recording;
    must(recording_read(path, &recording, &error));
    assert_false(recording.cut);
    const uint64_t steps = recording.steps;
    RecordingPlay play = {.path = path, .recording = &recording};
    headless_destroy(context); /* the session makes its own */
    must(recording_play_open(&play, NULL, HEADLESS_GPU_AUTO, false, &session, &error) == 0);
    while (recording_play_apply(&play, &session, &error) && !recording_play_ended(&play, &session))
        must(session_substep(&session, &error));
    if (world_hash(session.run.world) != recording.hash)
        fail_msg("%s: other bits", path);
    session_close(&session);
    recording_destroy(&recording);
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    assert_non_null(context);
    return steps;
}

static inline int rig_setup(void **state)
{
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    backends_add();
    return context && folder_setup(state) == 0 ? 0 : -1;
}

static inline int rig_teardown(void **state)
{
    headless_destroy(context);
    return folder_teardown(state);
}

#endif
