#include "app/session/recording_play.h"
#include "app/base/exit_code.h"

static bool load_scene(const RecordingPlay *play, const SceneSettings *more, Scene *scene, Error *error)
{
    const Recording *recording = play->recording;
    SceneSettings settings = recording->settings;
    for (int i = 0; more && i < more->count; i++) {
        if (settings.count == SCENE_SETTINGS_MAX)
            return error_set(error, "more than %d settings; leave --threads out", SCENE_SETTINGS_MAX);
        settings.said[settings.count] = more->said[i];
        settings.set[settings.count++] = more->set[i];
    }
    return scene_parse(recording->path, recording->text, recording->size, &settings, scene, NULL, error);
}

/* Whether the session came to a backend on a GPU while it ran. */
static bool moves_to_gpu(const Recording *recording)
{
    bool moves = false;
    for (size_t i = 0; i < recording->count; i++)
        moves |= sim_command_needs_gpu(&recording->commands[i]);
    return moves;
}

int recording_play_open(const RecordingPlay *play, const SceneSettings *more, int gpu, Session *session,
                        Error *error)
{
    Error why = {""};
    *session = (Session){.began_ms = wall_ms()};
    const bool loaded = load_scene(play, more, &session->scene, &why);
    const int code = loaded ? session_start(session, gpu, moves_to_gpu(play->recording), &why) : EXIT_USAGE;
    if (code != 0)
        error_set(error, "%.300s: its scene: %.600s", play->path, why.message);
    return code;
}

bool recording_play_apply(RecordingPlay *play, Session *session, Error *error)
{
    const Recording *recording = play->recording;
    Error why = {""};
    for (; play->next < recording->count; play->next++) {
        const SimCommand *command = &recording->commands[play->next];
        if (command->step != session->info.step)
            break;
        if (!sim_command_apply(command, &session->world, &session->scene, &why))
            return error_set(error, "%.300s:%zu: %.600s", play->path, recording_line(recording, play->next),
                             why.message);
    }
    world_info(session->world, &session->info);
    return true;
}

bool recording_play_ended(const RecordingPlay *play, const Session *session)
{
    return play->next == play->recording->count && session->info.step >= play->recording->steps;
}
