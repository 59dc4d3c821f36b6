#include "app/bench/bench_table.h"
#include "app/cli/cli_private.h"
#include "app/input/play_commands.h"
#include "app/scene/keys.h"
#include "app/scene/scene_files.h"

#include <stddef.h>

enum {
    PLAY = 1 << COMMAND_PLAY,
    RENDER = 1 << COMMAND_RENDER,
    RUN = 1 << COMMAND_RUN,
    BENCH = 1 << COMMAND_BENCH,
    VALIDATE = 1 << COMMAND_VALIDATE,
    CHART = 1 << COMMAND_CHART,
    STABILITY = 1 << COMMAND_STABILITY,
    FIT = 1 << COMMAND_FIT,
    REPLAY = 1 << COMMAND_REPLAY,
    EXPORT = 1 << COMMAND_EXPORT,
    DEVICES = 1 << COMMAND_DEVICES,
    SCENES = 1 << COMMAND_SCENES,
    NEW = 1 << COMMAND_NEW,
    INFO = 1 << COMMAND_INFO,
    ALL = PLAY | RENDER | RUN | BENCH | VALIDATE | CHART | STABILITY | FIT | INFO
};

static const CommandRow command_rows[] = {
    {COMMAND_PLAY, "play", "[SCENE|IN.h5part] [OPTIONS]",
     "opens the window: the box in your hand, or a recorded run; without a scene, box_slosh", 0, 1, NULL,
     1280, 720},
    {COMMAND_RENDER, "render", "SCENE|IN.h5part|SESSION -o OUT.png|OUT.mp4|OUT.gif|FOLDER ...",
     "a scene, a recorded run or a recorded session as a picture, a video or a folder of pictures; needs no display",
     1, 1, "OUT.png, OUT.mp4, OUT.gif or a folder", 1280, 720},
    {COMMAND_RUN, "run", "SCENE -o OUT.h5part [OPTIONS]",
     "simulates a scene into snapshots that ParaView opens", 1, 1, "OUT.h5part", 1280, 720},
    {COMMAND_BENCH, "bench", "[SCENE...] [OPTIONS]", "measures how long each stage of a frame takes", 0,
     ARGS_SCENES_MAX, NULL, 512, 512},
    {COMMAND_VALIDATE, "validate", "[CASE...] [OPTIONS]",
     "known flows against their references; without a CASE, all", 0, ARGS_SCENES_MAX, NULL, 0, 0},
    {COMMAND_CHART, "chart", "SCENE|CASE -o OUT.svg|.png [OPTIONS]",
     "speed against accuracy over methods, steps and resolutions", 1, 1, "OUT.svg or OUT.png", 0, 0},
    {COMMAND_STABILITY, "stability", "SCENE -o OUT.svg|.png [OPTIONS]",
     "where methods hold and how they fail: the largest step over two keys of a scene", 1, 1,
     "OUT.svg or OUT.png", 0, 0},
    {COMMAND_FIT, "fit", "SCENE|CASE --error PERCENT|--frame-ms MS ...",
     "the cheapest settings within an error, or with --frame-ms the most accurate in real time", 1, 1, NULL,
     0, 0},
    {COMMAND_REPLAY, "replay", "FILE [OPTIONS]",
     "a recorded session again, and whether it gives the same bits", 1, 1, NULL, 1280, 720},
    {COMMAND_EXPORT, "export", "IN.h5part -o OUT.pvd|.vtp|.ply|.obj|.csv|.vti ...",
     "writes snapshots in the formats of other programs", 1, 1,
     "OUT.pvd, OUT.vtp, OUT.ply, OUT.obj, or of a slice OUT.csv, OUT.vti or OUT.pvd", 256, 192},
    {COMMAND_DEVICES, "devices", "[--watch] [--record FILE] [OPTIONS]",
     "motion devices: which there are, what they say, and how to open them", 0, 0, NULL, 0, 0},
    {COMMAND_SCENES, "scenes", "[FOLDER] [-o FOLDER] [OPTIONS]",
     "lists the scenes that come with slosh, or those of a folder; with -o also as pictures", 0, 1, NULL, 0,
     0},
    {COMMAND_NEW, "new", "FILE.yaml [OPTIONS]",
     "writes the smallest scene, with a comment on each line, to begin with", 1, 1, NULL, 0, 0},
    {COMMAND_INFO, "info", "[SCENE] [OPTIONS]", "lists what there is to choose from, and a scene's settings",
     0, 1, NULL, 1280, 720},
    {COMMAND_HELP, "help", "[COMMAND|keys|window|presets]", "says what a command does and takes", 0, 0, NULL,
     0, 0},
    {0},
};

static const HelpTopic help_topics[] = {
    {"keys", "every key of a scene", scene_keys_print},
    {"window", "what keys, mouse and gamepad do in the window", play_commands_print},
    {"presets", "settings that go together, for --preset", preset_print},
    {"man", NULL, manual_print},
    {"bash", NULL, completion_print_bash},
    {"zsh", NULL, completion_print_zsh},
    {0},
};

/* Gives "box|world". */
#define X(NAME, name) "|" name
#define FRAMES        (&("" SNAPSHOT_FRAMES(X))[1])

#define AT(field) .offset = offsetof(Args, field)

/* clang-format off */
static const OptionRow option_rows[] = {
    {"-o", "OUT", RENDER | RUN | REPLAY | EXPORT, OPTION_TEXT, AT(output), .help = "the file or folder to write"},
    {"-o", "FOLDER", SCENES, OPTION_TEXT, AT(output), .help = "a folder for a small picture of each scene, and for index.html, which shows them all; a picture that is newer than its scene is kept"},
    {"-o", "OUT", BENCH, OPTION_TEXT, AT(output), .help = "the chart of --table: OUT.svg or OUT.png"},
    {"-o", "DIR", VALIDATE, OPTION_TEXT, AT(output), .help = "a folder for a plot a case, with the reference on it"},
    {"--full", NULL, VALIDATE, OPTION_FLAG, AT(full), .help = "finer, for as long as it takes"},
    {"--coarse", NULL, VALIDATE, OPTION_FLAG, AT(coarse), .help = "a glance: few particles, with tolerances of its own"},
    {"-o", "OUT", CHART, OPTION_TEXT, AT(output), .help = "the chart, OUT.svg or OUT.png; its figures in OUT.csv, which a later run goes on with"},
    {"--time", "S", CHART, OPTION_NUMBER, AT(time), .max = 1e6, .help = "simulated seconds of a scene (2; of --views 0.5); a case has its own"},
    {"--views", NULL, CHART, OPTION_FLAG, AT(views), .help = "instead: of each view and each of its settings the time of a picture against its error, at --time; --set view.kind=NAME: of that view"},
    {"--sweep", "KEY=A,B,...", CHART, OPTION_SWEEP, AT(sweeps), .help = "method=... or backend=...: those, in place of all methods, of the scene's backend and cpu, and of those on a GPU where there is one; particles.spacing=...: those, in place of 2, 1.5 and 1 of the scene's; any other scene key: a series each value; repeat for a product"},
    {"--size", "WxH", CHART, OPTION_SIZE, AT(width), .min = 1, .max = 16384, .help = "size of a picture of --views in pixels (256x256)"},
    {"-o", "OUT", STABILITY, OPTION_TEXT, AT(output), .help = "the map, OUT.svg or OUT.png; its trials in OUT.csv, which a later run goes on with"},
    {"--axis", "KEY=a:b", STABILITY, OPTION_AXIS, AT(axes), .help = "a key of the scene from a to b, at 8 values or, as a:b:n, at n; by factors where that is a decade and more; twice for a map (sound speed and viscosity around the scene's)"},
    {"--time", "S", STABILITY, OPTION_NUMBER, AT(time), .max = 1e6, .help = "simulated seconds of a trial (four times what a fall from the top takes)"},
    {"--sweep", "KEY=A,B,...", STABILITY, OPTION_SWEEP, AT(sweeps), .help = "method=... or backend=...: a map each, in place of the scene's own"},
    {"--error", "PERCENT", FIT, OPTION_NUMBER, AT(error), .max = 1000, .flags = OPTION_OPEN_LOW, .help = "the cheapest settings within that error against the scene's finest run, or the case's reference; more than 0: a run without error is the reference itself"},
    {"--frame-ms", "MS", FIT, OPTION_NUMBER, AT(frame_ms), .max = 1e6, .flags = OPTION_OPEN_LOW, .help = "the most accurate settings that compute a frame, 1/30 s, in so many ms in the mean, and no slower than real time"},
    {"-o", "OUT", FIT, OPTION_TEXT, AT(output), .help = "the scene with these settings, OUT.yaml (NAME_fit.yaml); its runs in OUT.csv, which a later run goes on with"},
    {"--time", "S", FIT, OPTION_NUMBER, AT(time), .max = 1e6, .help = "simulated seconds of a scene (2); a case has its own"},
    {"--table", "NAME", BENCH, OPTION_TEXT, AT(table),
     .help = "a published table again, beside its figures", .names = bench_table_choice},
    {"--time", "S", RENDER, OPTION_NUMBER, AT(time), .max = 1e6, .help = "simulated seconds (5; of a recorded run or session all of it, and the one picture of its end)"},
    {"--time", "S", RUN, OPTION_NUMBER, AT(time), .max = 1e6, .help = "simulated seconds (5)"},
    {"--time", "S", BENCH, OPTION_NUMBER, AT(time), .max = 1e6,
     .help = "measure from the first frame at or after that time on (0)"},
    {"--time", "S", EXPORT, OPTION_NUMBER, AT(time), .max = 1e6,
     .help = "the one snapshot at that time, or the first after it (the last)"},
    {"--frame", FRAMES, EXPORT, OPTION_CHOICE, AT(frame), .min = FRAME_BOX,
     .help = "whose positions and velocities are written (box)"},
    {"--surface", NULL, EXPORT, OPTION_FLAG, AT(surface), .help = "the fluid's surface as a mesh instead of the particles"},
    {"--fluids", NULL, EXPORT, OPTION_FLAG, AT(fluids), .help = "with --surface: a mesh of each fluid with a smooth border between them, as blocks of a .pvd or objects of a .obj"},
    {"--solids", NULL, EXPORT, OPTION_FLAG, AT(solids), .help = "beside them each solid as a mesh of its own that moves with it: a block of a .pvd, or with --surface an object of a .obj"},
    {"--level", "F", EXPORT, OPTION_NUMBER, AT(level), .max = 0.99, .flags = OPTION_OPEN_LOW,
     .help = "level of the field at the surface (the level that encloses the fluid's volume: about 0.5)"},
    {"--cell", "SPACINGS", EXPORT, OPTION_NUMBER, AT(cell), .min = 0.05, .max = 4,
     .help = "side of the cells of the surface (0.5)"},
    {"--color-by", "fluid|speed|density|pressure", EXPORT, OPTION_CHOICE, AT(color_by), .min = COLOR_CHOICE_FLUID,
     .help = "colours of a .ply or a .obj: the fluids' own, or a colormap from the least to the greatest value (fluid)"},
    {"--slice", "{point: [X, Y, Z], normal: [X, Y, Z]}", EXPORT, OPTION_TEXT, AT(slice),
     .help = "a scalar on that plane, in the box's frame, as OUT.vti or OUT.csv; m"},
    {"--trails", "{stride: N, length: S, ...}", EXPORT, OPTION_TEXT, AT(trails),
     .help = "the paths of particles up to that time, as OUT.vtp: keys stride, ids, length, every, region_min, region_max, plane_point, plane_normal, as of the overlay trails; {}: of every 20th from the first step on"},
    {"--scalar", "NAME", EXPORT, OPTION_TEXT, AT(scalar),
     .help = "scalar of the slice (pressure) or of the trails (speed)", .names = export_scalar_choice},
    {"--kernel", "NAME", EXPORT, OPTION_TEXT, AT(kernel),
     .help = "kernel of the slice (the kernel of the file's method)", .names = export_kernel_choice},
    {"--raw", NULL, EXPORT, OPTION_FLAG, AT(raw), .help = "the slice as sums of V W s, without the division by the sums of V W"},
    {"--size", "WxH", EXPORT, OPTION_SIZE, AT(width), .min = 1, .max = 16384,
     .help = "samples of the slice along and up"},
    {"--every", "S", RUN | REPLAY, OPTION_NUMBER, AT(every), .max = 1e6, .flags = OPTION_OPEN_LOW,
     .help = "seconds from snapshot to snapshot (1/30)"},
    {"--interpolate", NULL, RENDER, OPTION_FLAG, AT(interpolate),
     .help = "with a fixed step: pictures of the states between steps, at their own times"},
    {"--forces", "FILE", RUN, OPTION_TEXT, AT(forces), .help = "what the fluid does to the box and to each solid, N and N m, a row a frame, as CSV; not with backend fragment"},
    {"--probes", "FILE", RUN, OPTION_TEXT, AT(probes), .help = "what the scene's probes read, a row a step: FILE.csv; FILE.svg or FILE.png: a plot of that too"},
    {"--resume", NULL, RUN, OPTION_FLAG, AT(resume), .help = "go on behind the last snapshot of OUT, to the same bits"},
    {"--frames", "N", RENDER | BENCH, OPTION_COUNT, AT(frames), .min = 1, .max = 1e7, .help = "number of frames"},
    {"--fps", "N", RENDER, OPTION_NUMBER, AT(fps), .min = 0.001, .max = 1000,
     .help = "frames in a second (30)"},
    {"--size", "WxH", PLAY | RENDER | BENCH, OPTION_SIZE, AT(width), .min = 1, .max = 16384,
     .help = "width and height of the picture in pixels"},
    {"--record", "FILE", PLAY, OPTION_TEXT, AT(record), .help = "write the session there at the end, for slosh replay"},
    {"--past", "MIB", PLAY, OPTION_NUMBER, AT(past), .max = 1e6,
     .help = "memory for states of the past, to step back to (256); 0: none are kept"},
    {"--record", "FILE", DEVICES, OPTION_TEXT, AT(record), .help = "write all raw reports there, with their times, for --device file:FILE; until Ctrl-C"},
    {"--play", NULL, BENCH, OPTION_FLAG, AT(play), .help = "measure the live window, the box shaken by a script"},
    {"--seconds", "S", BENCH, OPTION_NUMBER, AT(seconds), .max = 1e5, .flags = OPTION_OPEN_LOW,
     .help = "how long, with --play; with --micro at most, for one count of particles (20)"},
    {"--micro", NULL, BENCH, OPTION_FLAG, AT(micro),
     .help = "each pass of a method alone on cpu, at 10000 to 4000000 particles, beside what the machine could do; with --time S at that time too"},
    {"--ablate", NULL, BENCH, OPTION_FLAG, AT(ablate),
     .help = "what each term of the scene's model costs, and what its metrics change without it: --time S simulated seconds (2) without each, in turn"},
    {"--clock", "gl|finish", BENCH, OPTION_CHOICE, AT(clock), .min = CLOCK_CHOICE_GL,
     .help = "GPU stages by GL timer queries, or by glFinish and the CPU's clock"},
    {"--sweep", "KEY=A,B,...", BENCH, OPTION_SWEEP, AT(sweeps),
     .help = "measure with each value: particles, backend, method, view, threads or any scene key; repeat for a product"},
    {"--compare", "KEY=A,B,...", RENDER, OPTION_SWEEP, AT(sweeps),
     .help = "two or four settings side by side in one picture: particles, backend, method, view or any scene key; twice with two values each for all four"},
    {"--set", "PATH=VALUE", ALL, OPTION_SETTING, AT(settings),
     .help = "any key of the scene, such as solver.step.dt=0.01; repeat for more"},
    {"--particles", "N", ALL, OPTION_PARTICLES, AT(settings.particles), .min = 1, .max = 2147483647,
     .help = "the spacing that gives about N particles"},
    {"--backend", "NAME", ALL, OPTION_SETTING, AT(settings), .path = "solver.backend", .help = "what computes the fluid"},
    {"--method", "NAME", ALL, OPTION_SETTING, AT(settings), .path = "solver.method", .help = "the equations of the solver"},
    {"--view", "NAME", ALL & ~(VALIDATE | CHART | STABILITY | FIT), OPTION_SETTING, AT(settings), .path = "view.kind", .help = "how the fluid is drawn"},
    {"--preset", "NAME", PLAY | RENDER | RUN | BENCH | INFO, OPTION_SETTING, AT(settings), .path = "preset", .help = "settings that go together, in place of the scene's: of a fluid (NAME:FLUID: of that one of several) or of the solver; --set goes before it", .names = preset_name},
    {"--threads", "N", ALL | REPLAY, OPTION_SETTING, AT(settings), .path = "solver.threads", .help = "threads of the CPU; 0: one for each processor"},
    {"--simd", "NAME", ALL | REPLAY, OPTION_SETTING, AT(settings), .path = "solver.simd", .help = "SIMD instructions of the CPU solver"},
    {"--gpu", "N", SCENES | RENDER | RUN | BENCH | VALIDATE | CHART | STABILITY | FIT | REPLAY | INFO, OPTION_COUNT, AT(gpu), .max = 15, .help = "which GPU, counted from 0"},
    {"--shaders", "DIR", PLAY | RENDER | RUN | BENCH | VALIDATE | CHART | STABILITY | FIT | REPLAY, OPTION_TEXT, AT(shaders), .help = "read the shaders from there; play reads them again when they change"},
    {"--device", "file:PATH", PLAY | DEVICES, OPTION_DEVICE, AT(device),
     .help = "a recording of motion devices in place of those that are plugged in"},
    {"--device", "file:PATH", RENDER | RUN | BENCH, OPTION_DEVICE, AT(device),
     .help = "a recording of motion devices (slosh devices --record) moves the box, in simulated time"},
    {"--device", "file:PATH", VALIDATE | CHART | STABILITY | FIT, OPTION_REFUSED, .help = "refused: what is compared moves as the scene says, and no other way"},
    {"--device", "file:PATH", REPLAY, OPTION_REFUSED, .help = "refused: all that moved the box is in the recorded session"},
    {"--device", "file:PATH", EXPORT, OPTION_REFUSED, .help = "refused: nothing is simulated; slosh run takes it"},
    {"--device", "file:PATH", INFO, OPTION_REFUSED, .help = "refused: nothing is simulated; slosh devices lists what is in a recording"},
    {"--mapping", "FILE", PLAY | RENDER | RUN | BENCH, OPTION_TEXT, AT(mapping),
     .help = "what motion devices do (the user's slosh/mapping.yaml, if there is one, or what is built in)"},
    {"--mapping", "FILE", DEVICES, OPTION_TEXT, AT(mapping), .help = "check such a file, and say in words what devices do by it"},
    {"--write-mapping", "FILE", DEVICES, OPTION_TEXT, AT(write_mapping), .help = "write what devices do into a new file, to be changed"},
    {"--watch", NULL, DEVICES, OPTION_FLAG, AT(watch), .help = "show what they say, live, until Ctrl-C or the end of the recording"},
    {"--save", "FILE", INFO, OPTION_TEXT, AT(save), .help = "write the scene with what --set and the like say into a new file FILE.yaml, comments and all"},
    {"--json", "FILE", ALL | SCENES | REPLAY | EXPORT | DEVICES, OPTION_TEXT, AT(json), .help = "also write the figures as JSON into FILE; -: standard output"},
    {"--quiet", NULL, ALL | SCENES | NEW | REPLAY | EXPORT | DEVICES, OPTION_FLAG, AT(quiet), .help = "no progress and no table"},
    {"--help", NULL, ALL | SCENES | NEW | REPLAY | EXPORT | DEVICES, OPTION_HELP, .help = "this text"},
    {0},
};
/* clang-format on */
#undef X

const ArgsTable cli_table = {command_rows, option_rows, help_topics};

const CommandRow *command_row(Command command)
{
    const CommandRow *row = command_rows;
    while (row->name && row->command != command)
        row++;
    return row;
}

static void help_program(FILE *file)
{
    fprintf(file, "slosh: a fluid of particles, simulated, shown and measured\n\n");
    for (const CommandRow *row = command_rows; row->name; row++)
        fprintf(file, "  slosh %-9s %-44s %s\n", row->name, row->usage, row->help);
    fprintf(file, "  slosh %-54s %s\n", "--version", "says which slosh this is");
    fprintf(file, "\n");
    for (const HelpTopic *topic = help_topics; topic->name; topic++)
        if (topic->help)
            fprintf(file, "`slosh help %s`: %s.\n", topic->name, topic->help);
    fprintf(
        file,
        "`slosh help COMMAND` lists its options. SCENE is a file, or the name of one that comes with slosh:\n");
    SceneNames scenes;
    scene_path_names(&scenes);
    int column = 0;
    for (int i = 0; i < scenes.count; i++) {
        const char *end = i + 1 < scenes.count ? "," : "\n";
        column = column > 90 ? 0 : column;
        column += fprintf(file, "%s%s%s", column ? " " : i ? "\n  " : "  ", scenes.name[i], end);
    }
}

bool option_listed(const OptionRow *option, Command command)
{
    return option->commands & 1u << command && option->kind != OPTION_REFUSED;
}

void option_words(const CommandRow *row, const OptionRow *option, char *text, size_t size)
{
    const Key *key = option->path ? scene_key_find(option->path) : NULL;
    const Key named = {.choice = option->names}, *names = key ? key : &named;
    size_t at = (size_t)snprintf(text, size, "%s", option->help);
    for (int i = 0; key_choice(names, i) && at < size; i++)
        at += (size_t)snprintf(text + at, size - at, "%s%s", i ? ", " : ": ", key_choice(names, i));
    if (option->kind == OPTION_SIZE && row->width > 0 && at < size)
        snprintf(text + at, size - at, " (%dx%d)", row->width, row->height);
}

void cli_help(Command command, FILE *file)
{
    const CommandRow *row = command_row(command);
    if (!row->name || command == COMMAND_HELP || command == COMMAND_VERSION) {
        help_program(file);
        return;
    }
    fprintf(file, "slosh %s %s\n%s\n\n", row->name, row->usage, row->help);
    for (const OptionRow *option = option_rows; option->name; option++) {
        char left[64], words[OPTION_WORDS_SIZE];
        if (!option_listed(option, command))
            continue;
        snprintf(left, sizeof left, "%s %s", option->name, option->value ? option->value : "");
        option_words(row, option, words, sizeof words);
        fprintf(file, "  %-22s %s\n", left, words);
    }
}
