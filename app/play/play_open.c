/* From scene to scene: what is open, what is still ending, and the session of it. */
#include "app/play/play_state.h"
#include "sim/base/stage.h"
#include "sim/gl/debug.h"
#include "sim/world/world.h"

#include <stdio.h>

static const double LEAVE_MS = 200, SAVE_MS = 5000;

/* A HandSend. */
static uint64_t send_target(void *simulator, const BoxTarget *target)
{
    const SimCommand command = {.kind = SIM_TARGET, .target = *target};
    return simulator_send(simulator, &command);
}

static void adopt(Play *play, const PlayScene *opened)
{
    char title[192];
    play->open = *opened;
    play->file_scene = opened->scene;
    play->has_particles = play->orbiting = false;
    hand_post_open(play->post, send_target, play->open.simulator);
    play->input = (PlayInput){.drag = PLAY_NONE};
    play->saves = play->messages = 0;
    play->scenes_opened++;
    play->dirty = true;
    meter_forget(&play->meter);
    snprintf(title, sizeof title, "%s - slosh", opened->scene.title);
    window_title(play->window, title);
    simulator_set_speed(play->open.simulator, play->speed);
}

/* A software renderer keeps all processors busy by itself. A solver on as many threads waits at each of its
   many barriers until the last of them gets its turn: on two processors a frame took 30 ms with two threads,
   and 18 with one. The bits do not depend on it. */
static void share_processors(WorldDef *def)
{
    if (def->threads == 0 && gl_renderer_is_software())
        def->threads = world_processors() > 1 ? world_processors() / 2 : 1;
}

bool play_save_now(Play *play, const char *path, Error *error)
{
    const double until = wall_ms() + SAVE_MS;
    for (bool asked = false;; window_wait(play->window, 0.01)) {
        play_listen(play);
        if (asked && !play->status.saving)
            return play->status.saved || error_set(error, "%s", play->status.save_message);
        if (play->status.ended || wall_ms() > until)
            return error_set(error, "%s: the session cannot be saved, its simulation does not answer", path);
        asked = asked || simulator_save(play->open.simulator, path);
        simulator_work(play->open.simulator, 0);
    }
}

/* With --record nothing that was done goes without a trace, though only the last session gets that name. */
static void keep_session(Play *play)
{
    Error error = {{0}};
    char path[1024];
    play_name_file(path, "recording");
    if (play->setup->record && play->status.step > 0 && !play_save_now(play, path, &error))
        play_error(play, error.message);
}

bool play_leave(Play *play, double patience_ms)
{
    return play_scene_close(&play->left, patience_ms);
}

/* A frame of a large scene lasts: its solver ends behind the next one's back. */
static void leave(Play *play)
{
    const double until = wall_ms() + SAVE_MS;
    if (!play->open.simulator)
        return;
    hand_post_close(play->post);
    keep_session(play);
    while (play->status.saving && !play->status.ended && wall_ms() < until) {
        window_wait(play->window, 0.01);
        simulator_work(play->open.simulator, 0);
        play_listen(play);
    }
    play->simulated_s += play->status.simulated_s;
    play->status = (SimulatorStatus){.time = 0};
    if (play_scene_close(&play->open, LEAVE_MS))
        return;
    play->left = play->open;
    play->open = (PlayScene){.upload = NULL};
}

/* On the terminal each with its place in the file, in the picture the first of them; the panel has all. */
static void tell(Play *play, const Notes *notes)
{
    for (int i = notes->count - 1; i >= 0; i--)
        play_tell(play, "%s", notes->line[i]);
    play_scene_advise(&play->open, NULL, NULL);
}

/* On failure the scene that is open stays. */
bool play_open(Play *play, const char *scene, const SceneSettings *settings, Error *error)
{
    PlayScene opened;
    Notes notes;
    if (!play_leave(play, 0))
        return error_set(error, "the scene before the present one is still ending; try again in a moment");
    const bool read = play_scene_read(&opened, scene, settings, &notes, error);
    share_processors(&opened.scene.world);
    if (!read || !play_scene_start(&opened, window_wake, play->timer, play->paused, error)) {
        play_scene_close(&opened, SAVE_MS);
        return false;
    }
    leave(play);
    adopt(play, &opened);
    tell(play, &notes);
    if (play->renderer)
        play_view_changed(play);
    return true;
}

void play_reset(Play *play)
{
    keep_session(play);
    hand_post_close(play->post); /* no report comes in between: it would move the box, and be forgotten */
    simulator_reset(play->open.simulator);
    hand_post_open(play->post, send_target, play->open.simulator);
}
