#include "app/window/play.h"
#include "app/base/file.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/input/device/device.h"
#include "app/run/playback/playback.h"
#include "app/window/model.h"

#include <stdio.h>

static const char *const default_scene = "scenes/box_slosh.yaml";

typedef struct PlayOptions {
    const char *record; /* FILE, or NULL */
    double history_mib; /* MiB of states for going back in time */
} PlayOptions;

static const PlayOptions *own(const Args *args)
{
    return args->own;
}

static int fail(const Error *error, int code)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

/* Checks that the window can open the scene, before there is a window. */
static bool check_scene(const char *scene, const Args *args, Error *error)
{
    PlayScene checked = {0};
    Notes notes;
    const bool ok = play_scene_read(&checked, scene, &args->settings, &notes, error);
    play_scene_close(&checked, 0);
    return ok;
}

static bool check_recorded(const char *file, const Args *args, Error *error)
{
    const char *option = own(args)->record            ? "--record"
                         : args->device               ? "--device"
                         : args_given(args, "--past") ? "--past"
                                                      : NULL;
    if (option)
        return error_set(error, "%s makes no sense for %s: nothing is simulated", option, file);
    return check_scene(file, args, error);
}

static int run_command(const Args *args)
{
    const char *scene = args->scene_count ? args->scenes[0] : default_scene;
    Mapping mapping = {0};
    const PlaySetup setup = {.scene = scene,
                             .settings = &args->settings,
                             .width = args->width,
                             .height = args->height,
                             .record = own(args)->record,
                             .history_bytes = (size_t)(own(args)->history_mib * 1048576),
                             .mapping = &mapping,
                             .device = args->device,
                             .json = args->json,
                             .quiet = args->quiet};
    PlayFigures figures = {0};
    Error error = {{0}};
    if (!(recorded_is_file(scene) ? check_recorded : check_scene)(scene, args, &error) ||
        !mapping_load(args->mapping, &mapping, &error) ||
        (args->device && !devices_check(args->device, &error)))
        return fail(&error, EXIT_USAGE);
    if ((own(args)->record && !output_check(own(args)->record, &error)) ||
        (args->json && !json_file_check(args->json, &error)))
        return fail(&error, EXIT_FAILED);
    const int code = play(&setup, &figures);
    if (args->json && !play_figures_write_json(&figures, args->json, &error))
        return fail(&error, EXIT_FAILED);
    return code;
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_PICTURE_SIZE,
    {"--record", "FILE", OPTION_TEXT, OWN(PlayOptions, record), .files = files_replaced,
     .help = "write the session there at the end, for slosh replay"},
    {"--past", "MIB", OPTION_NUMBER, OWN(PlayOptions, history_mib), .initial = PLAY_HISTORY_MIB, .max = 1e6,
     .help = "memory for states of the past, to step back to (256); 0: none are kept"},
    ROWS_SCENE, ROW_VIEW, ROW_PRESET, ROWS_PROCESSOR, ROW_SHADERS,
    ROW_DEVICE("a recording of motion devices in place of those that are plugged in"), ROW_MAPPING(MAPPING_HELP),
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_play = {
    .name = "play",
    .usage = "[SCENE|IN.h5part] [OPTIONS]",
    .help =
        "opens the window: the box in your hand, or a recorded run, or particles of other programs; without a scene, box_slosh",
    .takes = "scene",
    .takes_max = 1,
    .width = 1280,
    .height = 720,
    .own_size = sizeof(PlayOptions),
    .argument_files = files_scene,
    .options = options,
    .run = run_command,
};
