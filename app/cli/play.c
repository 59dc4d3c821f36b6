#include "app/window/play.h"
#include "app/base/file.h"
#include "app/base/output.h"
#include "app/cli/cli_private.h"
#include "app/input/device/devices.h"
#include "app/run/playback/playback.h"
#include "app/window/model.h"

#include <stdio.h>

static const char *const default_scene = "scenes/box_slosh.yaml";

static int fail(const Error *error, int code)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

/* Checks that the window can open the scene, before there is a window. */
static bool check_scene(const char *scene, const Args *args, Error *error)
{
    static PlayScene checked;
    Notes notes;
    const bool ok = play_scene_read(&checked, scene, &args->settings, &notes, error);
    play_scene_close(&checked, 0);
    return ok;
}

static bool check_recorded(const char *file, const Args *args, Error *error)
{
    const char *option = args->record       ? "--record"
                         : args->device     ? "--device"
                         : args->past_given ? "--past"
                                            : NULL;
    if (option)
        return error_set(error, "%s makes no sense for %s: nothing is simulated", option, file);
    return check_scene(file, args, error);
}

int cmd_play(const Args *args)
{
    const char *scene = args->scene_count ? args->scenes[0] : default_scene;
    static Mapping mapping;
    const PlaySetup setup = {.scene = scene,
                             .settings = &args->settings,
                             .width = args->width,
                             .height = args->height,
                             .record = args->record,
                             .history_bytes = (size_t)(args->past * 1048576),
                             .mapping = &mapping,
                             .device = args->device,
                             .json = args->json,
                             .quiet = args->quiet};
    static PlayFigures figures;
    Error error = {{0}};
    if (!(recorded_is_file(scene) ? check_recorded : check_scene)(scene, args, &error) ||
        !mapping_load(args->mapping, &mapping, &error) ||
        (args->device && !devices_check(args->device, &error)))
        return fail(&error, EXIT_USAGE);
    if ((args->record && !output_check(args->record, &error)) ||
        (args->json && !json_file_check(args->json, &error)))
        return fail(&error, EXIT_FAILED);
    const int code = play(&setup, &figures);
    if (args->json && !play_figures_write_json(&figures, args->json, &error))
        return fail(&error, EXIT_FAILED);
    return code;
}
