/* A simulation as the window's source, built on app/run/simulator.h. */
#include "app/play/scene.h"
#include "app/run/compare/compare.h"
#include "render/renderer.h"

static bool start(PlayScene *open, const SimulatorSetup *how, Error *error)
{
    SimulatorSetup setup = *how;
    if (!play_scene_make_upload(open, error))
        return false;
    setup.scene = &open->scene;
    setup.recording = &open->recording;
    setup.script = open->session ? &open->recording : NULL;
    setup.upload = open->upload;
    open->simulator = simulator_create(&setup, error);
    return open->simulator != NULL;
}

static bool close(PlayScene *open, double patience_ms)
{
    if (!simulator_destroy(open->simulator, patience_ms))
        return false;
    upload_destroy(open->upload);
    return true;
}

static double work(PlayScene *open, double budget_ms)
{
    return simulator_work(open->simulator, budget_ms);
}

static void status(PlayScene *open, SimulatorStatus *out)
{
    simulator_status(open->simulator, out);
}

static bool fresh(PlayScene *open)
{
    return simulator_on_gpu(open->simulator) ? simulator_fresh(open->simulator) : upload_fresh(open->upload);
}

static bool take(PlayScene *open, ParticleBuffers *out)
{
    const Scene *scene = &open->scene;
    unsigned attributes = renderer_attributes(&scene->view) | PARTICLE_ID; /* for clicks on particles */
    if (!simulator_on_gpu(open->simulator))
        return upload_take(open->upload, out);
    for (int i = 0; i < scene->view_count; i++)
        attributes |= renderer_attributes(&scene->views[i]);
    return simulator_share(open->simulator, attributes, out);
}

static bool has(const PlayScene *open, const ViewDef *view, Error *error)
{
    return compare_simulated_has(&open->scene.world, view, error);
}

static void pause(PlayScene *open, bool paused)
{
    simulator_pause(open->simulator, paused);
}

static void step(PlayScene *open, int frames, bool held)
{
    if (frames > 0)
        simulator_single_step(open->simulator, held);
    else
        simulator_step_back(open->simulator, held);
}

static void go_by(PlayScene *open, double seconds)
{
    simulator_go_by(open->simulator, seconds);
}

static void go_to(PlayScene *open, double time)
{
    simulator_go_to(open->simulator, time);
}

static void set_speed(PlayScene *open, double speed)
{
    simulator_set_speed(open->simulator, speed);
}

static void reset(PlayScene *open)
{
    simulator_reset(open->simulator);
}

const SourceKind source_simulator = {.simulates = true,
                                     .start = start,
                                     .close = close,
                                     .work = work,
                                     .status = status,
                                     .fresh = fresh,
                                     .take = take,
                                     .has = has,
                                     .pause = pause,
                                     .step = step,
                                     .go_by = go_by,
                                     .go_to = go_to,
                                     .set_speed = set_speed,
                                     .reset = reset};
