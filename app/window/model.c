#include "app/window/model.h"

#include "app/base/program.h"
#include "app/files/pictures.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/flow/flow.h"
#include "sim/gpu/gl.h"
#include "sim/start/start.h"
#include "sim/world.h"

#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

static const double NOTICE_MS = 4000;

static void show(Notice *notice, const char *words)
{
    snprintf(notice->words, sizeof notice->words, "%.300s", words);
    notice->until_ms = wall_ms() + NOTICE_MS;
    notice->fresh = true;
}

void notice_tell(Notice *notice, const char *format, ...)
{
    char words[sizeof(Error)];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(words, sizeof words, format, arguments);
    va_end(arguments);
    show(notice, words);
    if (!notice->quiet)
        fprintf(stderr, "%s\n", words);
}

void notice_error(Notice *notice, const char *message)
{
    show(notice, message);
    fprintf(stderr, "%s\n", message);
}

const char *notice_now(const Notice *notice)
{
    return wall_ms() < notice->until_ms ? notice->words : NULL;
}

bool notice_changed(Notice *notice)
{
    const bool stands = notice_now(notice) != NULL, changed = notice->fresh || stands != notice->stood;
    notice->fresh = false;
    notice->stood = stands;
    return changed;
}

static const double LEAVE_MS = 200, SAVE_MS = 5000, HASTE_MS = 400;

/* True if the program must end fast, or the display is gone. */
static bool in_haste(const PlayModel *model)
{
    return interrupted() || window_gone(model->window);
}

/* Differing padding only causes repeated advice. */
static bool same_bytes(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

/* After a jump in time, or a repeated command, takes over the settings of that time for the panel, and the
   box's pose of that time for the hand. */
static void follow_travels(PlayModel *model)
{
    const SimulatorHistory *timeline = &model->status.timeline;
    WorldDef def;
    if (timeline->travels == model->travels)
        return;
    model->travels = timeline->travels;
    simulator_settings(model->open.simulator, &def);
    if (!same_bytes(&def, &model->open.scene.world, sizeof def)) {
        model->open.scene.world = def;
        play_scene_advise(&model->open, NULL, NULL);
    }
    box_control_set_target(model->control, &timeline->target);
    model->closed_gates = model->status.closed_gates;
}

/* Takes over the solids from the solver. */
static void follow_solids(PlayModel *model)
{
    WorldDef def, *own = &model->open.scene.world;
    if (model->status.solids == model->solids)
        return;
    model->solids = model->status.solids;
    simulator_settings(model->open.simulator, &def);
    memcpy(own->box_size, def.box_size, sizeof own->box_size);
    own->solid_count = def.solid_count;
    memcpy(own->solids, def.solids, sizeof own->solids);
}

/* Reports once that the box of a recorded run cannot be moved, as a fixed box would look broken. */
static void tell_fixed(PlayModel *model)
{
    if (!atomic_exchange(&model->pulled, false) || model->fixed_reported)
        return;
    model->fixed_reported = true;
    notice_tell(model->notice, "a recorded run: its box moves as it did");
}

/* Reports when a recorded session begins, ends, or is left. */
static void tell_script(PlayModel *model)
{
    const ScriptState state = model->status.script;
    if (state == model->last_script)
        return;
    model->last_script = state;
    if (script_words(state))
        notice_tell(model->notice, "%s", script_words(state));
}

void model_read_status(PlayModel *model)
{
    SimulatorStatus *status = &model->status;
    model->open.source->status(&model->open, status);
    tell_fixed(model);
    if (status->messages != model->messages) {
        model->messages = status->messages;
        notice_error(model->notice, status->message);
    }
    char words[1280];
    while (compare_message(model->open.compared, words))
        notice_error(model->notice, words);
    follow_travels(model);
    follow_solids(model);
    tell_script(model);
    if (status->saves == model->saves)
        return;
    model->saves = status->saves;
    if (status->saved)
        notice_tell(model->notice, "%s", status->save_message);
    else
        notice_error(model->notice, status->save_message);
}

void model_take_state(PlayModel *model)
{
    PlayScene *open = &model->open;
    const bool together = open->compared && open->simulator;
    if (together)
        simulator_hold(open->simulator);
    model->has_particles = open->source->take(open, &model->particles);
    if (model->has_particles && open->compared)
        model->has_particles = compare_take(open->compared, model->particles.time);
    if (together)
        simulator_release(open->simulator);
}

bool model_has_new_state(const PlayModel *model)
{
    PlayScene *open = (PlayScene *)&model->open;
    return open->source->fresh(open) || compare_has_new(open->compared);
}

const ParticleBuffers *model_state(const PlayModel *model, const ViewDef *view)
{
    const ParticleBuffers *beside = compare_state(model->open.compared, view);
    return beside ? beside : &model->particles;
}

const WorldDef *model_world(const PlayModel *model, const ViewDef *view)
{
    const WorldDef *beside = compare_world(model->open.compared, view);
    return beside ? beside : &model->open.scene.world;
}

bool model_has(const PlayModel *model, const ViewDef *view, Error *error)
{
    const PlayScene *open = &model->open;
    return compare_world(open->compared, view) ? compare_has_attributes(open->compared, view, error)
                                               : open->source->has(open, view, error);
}

/* Name of the scene's own states in titles. */
static const char *own_name(const PlayScene *open)
{
    const char *slash = strrchr(open->scene.path, '/');
    return open->source->simulates ? "simulated" : slash ? slash + 1 : open->scene.path;
}

bool model_titles(const PlayModel *model, const ViewDef *const views[], int count, Title titles[PANELS_MAX])
{
    const PlayScene *open = &model->open;
    PanelFacts facts[PANELS_MAX];
    bool any = false;
    for (int i = 0; i < count; i++) {
        facts[i] = (PanelFacts){.words = "",
                                .said = "",
                                .def = &open->scene.world,
                                .particles = model->particles.count,
                                .spacing = model->particles.spacing,
                                .recorded = !open->source->simulates,
                                .first = -INFINITY,
                                .last = INFINITY};
        compare_facts(open->compared, views[i], &facts[i]);
        any |= *facts[i].words != 0;
    }
    for (int i = 0; i < count; i++)
        if (any)
            panel_title(facts, count, i, own_name(open), &titles[i]);
        else
            titles[i] = (Title){.words = ""};
    return any;
}

/* A BoxControlSend. */
static uint64_t send_target(void *open, const BoxTarget *target)
{
    const PlayScene *scene = open;
    const SimCommand command = {.kind = SIM_TARGET, .target = *target};
    compare_send(scene->compared, &command);
    return simulator_send(scene->simulator, &command);
}

/* A BoxControlSend without a simulation. */
static uint64_t send_nowhere(void *model, const BoxTarget *target)
{
    (void)target;
    atomic_store(&((PlayModel *)model)->pulled, true);
    return 0;
}

static void post_open(PlayModel *model)
{
    if (model->open.source->simulates)
        box_control_open(model->control, send_target, &model->open);
    else
        box_control_open(model->control, send_nowhere, model);
}

static void adopt(PlayModel *model, const PlayScene *opened)
{
    model->open = *opened;
    model->file_scene = opened->scene;
    model->has_particles = false;
    model->held = true;
    post_open(model);
    model->saves = model->messages = model->travels = model->solids = 0;
    model->closed_gates = flow_closed_gates(&opened->scene.world);
    model->fixed_reported = model->asked_acceleration = false;
    model->last_script = SCRIPT_NONE;
    model->scenes_opened++;
    watchdog_watch(model->guard, opened->simulator);
    model->seeded =
        opened->source->simulates ? seed_count(&opened->scene.world, opened->scene.world.spacing) : 0;
    model->open.source->set_speed(&model->open, model->speed);
}

/* Gives the solver half of the processors with a software renderer, which keeps all busy. A solver with as
   many threads as processors waits at each of its many barriers for a delayed thread. On two processors a
   frame took 30 ms with two threads, and 18 ms with one. The bits do not depend on the count. */
static void share_processors(WorldDef *def)
{
    int *threads = world_threads(def);
    if (*threads == 0 && gl_renderer_is_software())
        *threads = world_processors() > 1 ? world_processors() / 2 : 1;
}

/* Saves without the last frame, if the simulation does not answer. */
static bool save_cut(PlayModel *model, const char *path, Error *error)
{
    const bool ok = simulator_save_cut(model->open.simulator, path, error);
    if (ok)
        notice_tell(model->notice, "%s: the session, without its last frame, which lasts still", path);
    return ok;
}

bool model_save_now(PlayModel *model, const char *path, Error *error)
{
    const double until = wall_ms() + (in_haste(model) ? HASTE_MS : SAVE_MS);
    if (!model->open.source->simulates)
        return error_set(error, "%s: not written, since a recorded run is open, which has no session", path);
    for (bool asked = false;; window_wait(model->window, 0.01)) {
        model_read_status(model);
        if (asked && !model->status.saving)
            return model->status.saved || error_set(error, "%s", model->status.save_message);
        if (model->status.ended || wall_ms() > until)
            return save_cut(model, path, error);
        asked = asked || simulator_save(model->open.simulator, path);
        simulator_work(model->open.simulator, 0);
    }
}

/* With --record saves every left session, though only the last session gets the given name. */
bool model_save_before_leaving(PlayModel *model, Error *error)
{
    char path[1024];
    dated_file_name(path, "recording");
    model->kept = !model->open.source->simulates || !model->record || model->status.step == 0 ||
                  model_save_now(model, path, error);
    return model->kept;
}

/* Saves once; the session ends even if the save fails. */
static void keep_session(PlayModel *model)
{
    Error error = {{0}};
    if (!model->kept && !model_save_before_leaving(model, &error))
        notice_error(model->notice, error.message);
    model->kept = false;
}

bool model_end_previous(PlayModel *model, double patience_ms)
{
    return play_scene_close(&model->left, patience_ms);
}

/* Leaves the scene. A frame of a large scene takes long, so its solver ends while the next scene runs. */
static void leave(PlayModel *model)
{
    const double until = wall_ms() + SAVE_MS;
    if (!model->open.source)
        return;
    box_control_close(model->control);
    keep_session(model);
    while (model->status.saving && !model->status.ended && wall_ms() < until) {
        window_wait(model->window, 0.01);
        model->open.source->work(&model->open, 0);
        model_read_status(model);
    }
    watchdog_watch(model->guard, NULL);
    model->simulated_s += model->status.simulated_s;
    model->status = (SimulatorStatus){.time = 0};
    if (play_scene_close(&model->open, LEAVE_MS))
        return;
    model->left = model->open;
    model->open = (PlayScene){.source = NULL};
}

/* Prints all notes on the terminal, with their places in the file, and shows the first in the picture; the
   panel has all. */
static void tell(PlayModel *model, const Notes *notes)
{
    for (int i = notes->count - 1; i >= 0; i--)
        notice_tell(model->notice, "%s", notes->line[i]);
    play_scene_advise(&model->open, NULL, NULL);
}

bool model_open(PlayModel *model, const char *scene, const SceneSettings *settings, Error *error)
{
    PlayScene opened;
    WorldDef *def;
    Notes notes = {.count = 0};
    if (!model_end_previous(model, 0))
        return error_set(error, "the scene before the present one is still ending; try again in a moment");
    const bool read = play_scene_read(&opened, scene, settings, &notes, error);
    const SimulatorSetup how = {.wake = window_wake,
                                .timer = model->timer,
                                .paused = true, /* until model_shown */
                                .history_bytes = model->history_bytes};
    share_processors(&opened.scene.world);
    for (int i = 0; (def = compare_world_def(opened.compared, i)); i++)
        share_processors(def);
    if (!read || !play_scene_start(&opened, &how, error)) {
        play_scene_close(&opened, SAVE_MS);
        return false;
    }
    leave(model);
    adopt(model, &opened);
    tell(model, &notes);
    return true;
}

void model_reset(PlayModel *model)
{
    keep_session(model);
    box_control_close(model->control); /* a device report now would move the box, and would be lost */
    model->open.source->reset(&model->open);
    model->closed_gates = flow_closed_gates(&model->open.scene.world);
    post_open(model);
}

/* The view of the open scene without the user's choice. */
static void file_view(const PlayModel *model, char kind[NAME_SIZE])
{
    const Recording *file = &model->open.recording;
    SceneSettings none = {.purpose = SCENE_FOR_WINDOW};
    Scene scene;
    Error error;
    const bool parsed =
        file->text && scene_parse(file->path, file->text, file->size, &none, &scene, NULL, &error);
    snprintf(kind, NAME_SIZE, "%s", parsed ? scene.view.kind : model->file_scene.view.kind);
}

/* Remembers a view chosen by the user; the choice stays even if a file has the same view by chance. */
static void keep_view(PlayModel *model)
{
    char own[NAME_SIZE];
    const char *shown = model->open.scene.view.kind;
    file_view(model, own);
    if (strcmp(shown, own) != 0)
        snprintf(model->user_view, sizeof model->user_view, "%s", shown);
    else if (strcmp(shown, model->user_view) != 0)
        *model->user_view = 0;
}

/* Opens a scene with the user's view, and the command line's settings of that view; without both if the scene
   cannot have the view. */
static bool open_kept(PlayModel *model, const char *path, Error *error)
{
    char kind[16 + NAME_SIZE], own[16 + NAME_SIZE];
    const SceneSettings *said = &model->open.recording.settings;
    SceneSettings settings = {.count = 0};
    if (!*model->user_view)
        return model_open(model, path, NULL, error);
    snprintf(kind, sizeof kind, "view.kind=%s", model->user_view);
    snprintf(own, sizeof own, "view.%s.", model->user_view);
    settings.set[settings.count++] = kind;
    for (int i = 0; i < said->count && settings.count < SCENE_SETTINGS_MAX; i++)
        if (strncmp(said->set[i], own, strlen(own)) == 0)
            settings.set[settings.count++] = said->set[i];
    return model_open(model, path, &settings, error) || model_open(model, path, NULL, error);
}

bool model_open_neighbour(PlayModel *model, int by)
{
    char path[1024], present[1024];
    bool opened = false;
    keep_view(model);
    snprintf(present, sizeof present, "%s", model->open.scene.path);
    for (int way = by; !opened && play_scene_neighbour(present, way, path) && strcmp(path, present) != 0;
         way += by) {
        Error error = {{0}};
        opened = open_kept(model, path, &error);
        if (!opened)
            notice_error(model->notice, error.message);
    }
    if (!opened)
        notice_tell(model->notice, "there is no other scene to open beside %s", present);
    return opened;
}

bool model_close(PlayModel *model, double patience_ms)
{
    watchdog_watch(model->guard, NULL);
    return play_scene_close(&model->open, patience_ms) && model_end_previous(model, patience_ms);
}

void model_pause(PlayModel *model, bool paused)
{
    model->paused = paused;
    model->open.source->pause(&model->open, paused || model->held);
}

void model_shown(PlayModel *model)
{
    if (!model->held)
        return;
    model->held = false;
    model->open.source->pause(&model->open, model->paused);
}

void model_step(PlayModel *model, bool held)
{
    model->paused = true;
    model->open.source->step(&model->open, 1, held);
}

void model_step_back(PlayModel *model, bool held)
{
    model->paused = true;
    model->open.source->step(&model->open, -1, held);
}

void model_go_by(PlayModel *model, double seconds)
{
    model->open.source->go_by(&model->open, seconds);
}

void model_go_to(PlayModel *model, double time)
{
    model->open.source->go_to(&model->open, time);
}

void model_set_speed(PlayModel *model, double factor)
{
    static const double slowest = 1.0 / 64, fastest = 64;
    model->speed = fmin(fmax(model->speed * factor, slowest), fastest);
    model->open.source->set_speed(&model->open, model->speed);
    notice_tell(model->notice, "speed %g", model->speed);
}

void model_stop_box(PlayModel *model)
{
    model->open.source->status(&model->open, &model->status);
    box_control_release(model->control, &model->status.hand);
}

void model_save(PlayModel *model)
{
    char path[1024];
    dated_file_name(path, "recording");
    if (!simulator_save(model->open.simulator, path))
        notice_error(model->notice, "the session before is still being saved; try again in a moment");
}

static void advise_anew(PlayModel *model, const SimCommand *command)
{
    char path[SETTING_TEXT_SIZE];
    Notes fresh = {.count = 0};
    sim_command_path(command, path);
    play_scene_advise(&model->open, path, &fresh);
    for (int i = fresh.count - 1; i >= 0; i--)
        notice_tell(model->notice, "%s", fresh.line[i]);
}

/* Moves to a new backend, or keeps accelerations. */
static void move(PlayModel *model, const SimCommand *command, const char before[NAME_SIZE], bool kept)
{
    Error error = {{0}};
    WorldDef *world = &model->open.scene.world;
    if (play_scene_set_backend(&model->open, command, &error))
        return;
    memcpy(world->backend, before, NAME_SIZE);
    world->acceleration = kept;
    notice_error(model->notice, error.message);
}

void model_loop(PlayModel *model)
{
    PlayerStatus status;
    if (!model->open.player) {
        notice_tell(model->notice, "a simulation has no end to begin anew at");
        return;
    }
    player_status(model->open.player, &status);
    player_set_loop(model->open.player, !status.loop);
    notice_tell(model->notice, status.loop ? "stops at the end" : "begins anew at the end");
}

/* A recorded run has no keys of a solver to set. */
static bool may_concern(const PlayModel *model, const SimCommand *command, bool concerns_world, Error *error)
{
    char text[SETTING_TEXT_SIZE];
    if (!concerns_world || model->open.source->simulates)
        return true;
    sim_command_setting(command, text);
    return error_set(error, "%s: a recorded run stays as it was simulated", text);
}

static bool set_text(PlayModel *model, const SimCommand *command, bool *concerns_world, Error *error)
{
    Scene *scene = &model->open.scene;
    Scene changed = *scene;
    if (!scene_set_live(&changed, command->setting, concerns_world, error) ||
        !may_concern(model, command, *concerns_world, error) || !model_has(model, &changed.view, error))
        return false;
    *scene = changed;
    return true;
}

static bool set_value(PlayModel *model, const SimCommand *command, bool *concerns_world, Error *error)
{
    Scene *scene = &model->open.scene;
    SettingBefore before;
    if (!scene_set_value(scene, &command->value, &before, concerns_world, error))
        return false;
    if (may_concern(model, command, *concerns_world, error) && model_has(model, &scene->view, error))
        return true;
    scene_set_back(scene, &command->value, &before);
    return false;
}

/* Sets a key of the scene; a view without data is refused. */
static bool set_scene(PlayModel *model, const SimCommand *command, bool *concerns_world, Error *error)
{
    return command->kind == SIM_VALUE ? set_value(model, command, concerns_world, error)
                                      : set_text(model, command, concerns_world, error);
}

/* Checks that the backend may change: not with solvers side by side, as backends decide the stepping
   thread. */
static bool may_move(const PlayModel *model, const SimCommand *command, Error *error)
{
    Simulator *followers[SIMULATOR_FOLLOWERS];
    return !sim_command_sets_backend(command) || compare_followers(model->open.compared, followers) == 0 ||
           error_set(error, "%s: the backend stays while solvers run side by side; set it before the start",
                     command->setting);
}

/* Sends a change of the scene on to the solvers. */
static void send_change(PlayModel *model, const SimCommand *command)
{
    compare_send(model->open.compared, command);
    if (!sim_command_moves(command) && !simulator_send(model->open.simulator, command))
        notice_error(model->notice, "too many changes wait for the next step; let the time run");
}

static bool set(PlayModel *model, const SimCommand *command)
{
    Error error = {{0}};
    bool concerns_world;
    const WorldDef *world = &model->open.scene.world;
    char backend[NAME_SIZE];
    const bool kept = world->acceleration;
    memcpy(backend, world->backend, NAME_SIZE);
    if (!may_move(model, command, &error) || !set_scene(model, command, &concerns_world, &error)) {
        notice_error(model->notice, error.message);
        return false;
    }
    if (!model->open.source->simulates)
        return true;
    simulator_set_realtime(model->open.simulator, model->open.scene.realtime);
    advise_anew(model, command);
    if (concerns_world)
        send_change(model, command);
    if (sim_command_moves(command))
        move(model, command, backend, kept);
    return true;
}

bool model_set(PlayModel *model, const char *setting)
{
    SimCommand command = {.kind = SIM_SET};
    snprintf(command.setting, sizeof command.setting, "%s", setting);
    return set(model, &command);
}

/* A change with a new world is sent as text. */
bool model_set_value(PlayModel *model, const SettingValue *value)
{
    SimCommand command = {.kind = SIM_VALUE, .value = *value};
    if (sim_command_moves(&command)) {
        command.kind = SIM_SET;
        setting_value_text(value, command.setting);
    }
    return set(model, &command);
}

void model_set_gates(PlayModel *model, uint64_t gates)
{
    const SimCommand command = {.kind = SIM_GATES, .closed_gates = gates};
    if (!model->open.source->simulates)
        return;
    model->closed_gates = gates;
    compare_send(model->open.compared, &command);
    simulator_send(model->open.simulator, &command);
}

uint64_t model_touch(PlayModel *model, const Finger *finger)
{
    const SimCommand command = {.kind = SIM_TOUCH, .finger = *finger};
    if (!model->open.source->simulates)
        return 0;
    compare_send(model->open.compared, &command);
    return simulator_send(model->open.simulator, &command);
}

bool model_solid(PlayModel *model, const SolidCommand *command)
{
    Error error = {{0}};
    Simulator *followers[SIMULATOR_FOLLOWERS];
    WorldDef def = model->open.scene.world;
    const SimCommand sent = {.kind = SIM_SOLID, .solid = *command};
    def.solid_count += def.solid_count == 0;
    const bool may =
        world_can(&def, &error) && (compare_followers(model->open.compared, followers) == 0 ||
                                    error_set(&error, "solids stay while solvers run side by side"));
    if (!may)
        notice_error(model->notice, error.message);
    return may && simulator_send(model->open.simulator, &sent) > 0;
}

bool model_resize(PlayModel *model, const double size[3])
{
    Simulator *followers[SIMULATOR_FOLLOWERS];
    if (!model->open.source->simulates)
        return false;
    if (compare_followers(model->open.compared, followers) > 0) {
        notice_tell(model->notice, "the box keeps its size while solvers run side by side");
        return false;
    }
    simulator_resize(model->open.simulator, size);
    return true;
}

/* True if the scene's own states need accelerations; runs beside are asked for theirs. */
static bool follow_view(PlayModel *model, const ViewDef *view)
{
    if (!scene_view_reads_acceleration(view))
        return false;
    compare_want_accelerations(model->open.compared, view);
    return scene_shows(&model->open.scene, view);
}

void model_follow_views(PlayModel *model)
{
    const Scene *scene = &model->open.scene;
    if (!model->open.source->simulates)
        return;
    bool wants = follow_view(model, &scene->view);
    for (int i = 0; i < scene->view_count; i++)
        wants |= follow_view(model, &scene->views[i]);
    const bool asked = model->asked_acceleration;
    model->asked_acceleration = wants;
    if (wants && !asked && !scene->world.acceleration)
        model_set(model, "solver.acceleration=true");
}
