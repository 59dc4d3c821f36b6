/* A simulation as the window's source, built on app/run/simulator.h. */
#include "app/run/compare/compare.h"
#include "app/run/session.h"
#include "app/scene/scene.h"
#include "app/window/model.h"
#include "render/renderer.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Makes the upload for the particles, unless the backend is on the GPU. */
static bool play_scene_make_upload(PlayScene *open, Error *error);

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
    return simulator_on_gpu(open->simulator) ? simulator_fresh(open->simulator)
                                             : upload_has_new(open->upload);
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

const StateSource state_source_simulator = {.simulates = true,
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

/* Checks that a session stays on its backend: a move to or from a GPU changes the solver's thread, which only
   the window can do. */
static bool check_session(const char *path, const Recording *recording, Error *error)
{
    for (size_t i = 0; i < recording->count; i++)
        if (sim_command_sets_backend(&recording->commands[i]))
            return error_set(
                error,
                "%s:%zu: the session goes on with another backend here, which the window does not "
                "do again; `slosh replay %s` and `slosh render %s -o OUT.mp4` do",
                path, recording_line(recording, i), path, path);
    return true;
}

/* Removes views of runs beside the scene, which the session did not record. */
static void leave_out_beside(Scene *scene)
{
    int kept = 0;
    for (int i = 0; i < scene->view_count; i++)
        if (!compare_is_other(&scene->views[i]))
            scene->views[kept++] = scene->views[i];
    scene->view_count = kept;
}

static bool read_session(PlayScene *open, const char *path, const SceneSettings *settings, Notes *notes,
                         Error *error)
{
    Error why = {""};
    open->session = true;
    if (!recording_read(path, &open->recording, error) || !check_session(path, &open->recording, error) ||
        (settings && !recording_play_allows(path, settings, error)))
        return false;
    if (!recording_play_scene(&open->recording, settings, SCENE_FOR_WINDOW, &open->scene, notes, &why))
        return error_set(error, "%.300s: its scene: %.600s", path, why.message);
    leave_out_beside(&open->scene);
    return true;
}

/* For a scene embedded in a picture: notes that the simulation starts at the scene's start. */
static void tell_picture(const char *path, Notes *notes)
{
    PictureText text;
    Error none;
    if (!picture_text_name(path) || !picture_text_read(path, &text, &none))
        return;
    if (isfinite(text.time))
        notes_add(notes, "%.200s: a picture of %s at %.4g s; its scene begins at the start", path,
                  *text.name ? text.name : "a scene", text.time);
    free(text.scene);
}

static bool read_scene(PlayScene *open, const char *name, const SceneSettings *settings, Notes *notes,
                       Error *error)
{
    static const SceneSettings none;
    SceneSettings applied = settings ? *settings : none;
    applied.purpose = SCENE_FOR_WINDOW;
    char path[SCENE_PATH_SIZE];
    size_t size;
    if (!scene_path_find(name, path, error))
        return false;
    char *text = scene_file_read(path, &size, error);
    const CompareSetup compared = {.scene = &open->scene, .text = text, .size = size, .settings = settings};
    const bool ok =
        text && scene_parse(path, text, size, &applied, &open->scene, notes, error) &&
        recording_create(&open->recording, path, text, size, settings ? settings : &none, error) &&
        compare_read(&compared, &open->compared, notes, error);
    free(text);
    if (ok)
        tell_picture(path, notes);
    return ok;
}

static bool read_recorded(PlayScene *open, const char *path, const SceneSettings *settings, Notes *notes,
                          Error *error)
{
    *notes = (Notes){.count = 0};
    open->recorded = calloc(1, sizeof *open->recorded);
    if (!open->recorded)
        return error_set(error, "%s: out of memory", path);
    if (!recorded_open(path, settings, open->recorded, notes, error))
        return false;
    open->scene = open->recorded->scene;
    snprintf(open->scene.path, sizeof open->scene.path, "%s", path);
    for (int i = 0; i < scene_view_count(&open->scene); i++) {
        ViewDef *view = open->scene.view_count > 0 ? &open->scene.views[i] : &open->scene.view;
        if (!compare_is_other(view))
            recorded_adapt(open->recorded, view, notes);
    }
    return compare_read(&(CompareSetup){.scene = &open->scene}, &open->compared, notes, error);
}

static void tell_time(const Scene *scene, Notes *notes)
{
    if (scene->view_count == 0 && scene->view.time >= 0)
        notes_add(
            notes,
            "view.time has no effect in the window, which goes through all times; an entry of views shows one beside: views: [{}, {time: %g}]",
            scene->view.time);
}

bool play_scene_read(PlayScene *open, const char *name, const SceneSettings *settings, Notes *notes,
                     Error *error)
{
    const bool recorded = recorded_is_file(name);
    *open = (PlayScene){.source = recorded ? &state_source_recorded : &state_source_simulator};
    if (!(recorded                  ? read_recorded
          : recording_is_file(name) ? read_session
                                    : read_scene)(open, name, settings, notes, error))
        return false;
    tell_time(&open->scene, notes);
    open->notes = *notes;
    return true;
}

/* Adds a note on a changed key without effect, for as long as the scene is open. */
static void advise_unused(PlayScene *open, const char *path)
{
    scene_advise_key(&open->scene, path, &open->notes);
    open->notes.lasting = open->notes.count;
}

void play_scene_advise(PlayScene *open, const char *path, Notes *fresh)
{
    const Notes before = open->notes;
    open->notes.count = open->notes.lasting;
    if (path)
        advise_unused(open, path);
    scene_advise(NULL, &open->scene, &open->notes);
    for (int i = 0; fresh && i < open->notes.count; i++)
        if (!notes_have(&before, open->notes.line[i]))
            notes_add(fresh, "%s", open->notes.line[i]);
}

static bool play_scene_make_upload(PlayScene *open, Error *error)
{
    const WorldDef *def = &open->scene.world;
    if (!open->upload && !world_on_gpu(def))
        open->upload = upload_create(compare_simulated_particles(def),
                                     upload_attributes(compare_simulated_attributes(def)), error);
    return open->upload || world_on_gpu(def);
}

bool play_scene_start(PlayScene *open, const SimulatorSetup *how, Error *error)
{
    SimulatorSetup each = *how;
    Simulator *followers[SIMULATOR_FOLLOWERS];
    int solvers = 1;
    while (compare_world_def(open->compared, solvers - 1))
        solvers++;
    each.history_bytes = how->history_bytes / (size_t)solvers;
    if (!compare_start(open->compared, &each, error))
        return false;
    each.follower_count = compare_followers(open->compared, followers);
    each.followers = followers;
    return open->source->start(open, &each, error);
}

bool play_scene_set_backend(PlayScene *open, const SimCommand *command, Error *error)
{
    return play_scene_make_upload(open, error) &&
           simulator_move(open->simulator, command, open->upload, open->scene.world.backend, error);
}

bool play_scene_close(PlayScene *open, double patience_ms)
{
    if (open->source && !open->source->close(open, patience_ms))
        return false;
    compare_destroy(open->compared);
    recording_destroy(&open->recording);
    free(open->reloaded);
    *open = (PlayScene){.source = NULL};
    return true;
}

static int is_recorded(const struct dirent *entry)
{
    return recorded_is_file(entry->d_name);
}

bool play_scene_neighbour(const char *path, int by, char out[1024])
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    char folder[1024] = ".";
    struct dirent **entries;
    int place = -1;
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
    const int count = scandir(*folder ? folder : "/", &entries,
                              recorded_is_file(path) ? is_recorded : scene_path_is_yaml, alphasort);
    for (int i = 0; i < count; i++)
        if (strcmp(entries[i]->d_name, name) == 0)
            place = i;
    bool found = false;
    for (int k = 1; k < count && place >= 0 && !found; k++) { /* tables of probes beside a run are no runs */
        const char *next = entries[((place + k * by) % count + count) % count]->d_name;
        found = !recorded_is_file(path) || recorded_is_alike(path, next);
        if (found)
            snprintf(out, 1024, "%.760s/%s", folder, next);
    }
    for (int i = 0; i < count; i++)
        free(entries[i]);
    if (count >= 0)
        free(entries);
    return found;
}
