/* The command line: the parsed result, and the messages for errors. */
#include "tests/app/toy_command.h"
#include "tests/scene/scene_text.h"

#include "app/bench/bench.h"
#include "app/cli/cli.h"
#include "app/cli/cli_private.h"
#include "app/files/snapshot.h"
#include "sim/gpu/gl.h"

#include <stdlib.h>

enum { WORDS_MAX = 80 };

static Args args;
static Error error;

/* Parses "slosh " + line, split at blanks. */
static bool parse(const char *line)
{
    static char words[512];
    char *argv[WORDS_MAX + 1] = {"slosh"};
    int argc = 1;
    snprintf(words, sizeof words, "%s", line);
    for (char *word = strtok(words, " "); word && argc < WORDS_MAX; word = strtok(NULL, " "))
        argv[argc++] = word;
    error.message[0] = 0;
    args_free(&args);
    return args_parse(cli_commands, argc, argv, &args, &error);
}

/* Where the parsed command keeps the value of an option. */
static const void *value_of(const char *option)
{
    for (const OptionRow *row = args.command->options; row->name; row++)
        if (strcmp(row->name, option) == 0)
            return (const char *)(row->flags & OPTION_OWN ? args.own : &args) + row->offset;
    fail_msg("slosh %s has no %s", args.command->name, option);
    return NULL;
}

static double number(const char *option)
{
    return *(const double *)value_of(option);
}

static int count(const char *option)
{
    return *(const int *)value_of(option);
}

static const char *text(const char *option)
{
    return *(const char *const *)value_of(option);
}

static bool is_command(const char *name)
{
    return args.command && strcmp(args.command->name, name) == 0;
}

static void accept(const char *line)
{
    if (!parse(line))
        fail_msg("%s", error.message);
}

static void refuse(const char *line, const char *message)
{
    if (parse(line))
        fail_msg("accepted: %s", line);
    if (strncmp(error.message, message, strlen(message)) != 0)
        fail_msg("expected '%s'\n     got '%s'", message, error.message);
}

static void defaults(void **state)
{
    (void)state;
    accept("render a.yaml -o a.png");
    assert_true(is_command("render"));
    assert_true(args.scene_count == 1 && args.settings.count == 0 && args.settings.particles == 0);
    assert_string_equal(args.scenes[0], "a.yaml");
    assert_string_equal(args.output, "a.png");
    assert_true(args.time == 5 && number("--fps") == 30 && !args_given(&args, "--time") &&
                count("--frames") == 0);
    assert_true(args.width == 1280 && args.height == 720 && args.gpu == -1 && !args.quiet && !args.json);
    accept("bench");
    assert_true(is_command("bench") && args.scene_count == 0 && args.width == 512 && args.height == 512);
    assert_true(options_of_bench(&args)->clock == CLOCK_CHOICE_AUTO);
    accept("info");
    assert_true(is_command("info"));
}

static void every_option_reaches_its_field(void **state)
{
    (void)state;
    accept(
        "render -o out --time 2.5 --frames 7 --fps=24 --size 640x480 --gpu 1 --shaders sh --json j.json --quiet s");
    assert_string_equal(args.output, "out");
    assert_string_equal(args.scenes[0], "s");
    assert_true(args.time == 2.5 && args_given(&args, "--time") && count("--frames") == 7 &&
                number("--fps") == 24);
    assert_true(args.width == 640 && args.height == 480 && args.gpu == 1 && args.quiet);
    assert_string_equal(args.shaders, "sh");
    assert_string_equal(args.json, "j.json");
    accept("run s -o o.h5part --every 0.1 --time 0");
    assert_true(is_command("run") && number("--every") == 0.1 && args.time == 0 &&
                args_given(&args, "--time"));
    accept("bench a b c --clock finish");
    assert_true(args.scene_count == 3 && options_of_bench(&args)->clock == CLOCK_CHOICE_FINISH);
    accept("bench --clock=gl");
    assert_int_equal(options_of_bench(&args)->clock, CLOCK_CHOICE_GL);
    accept("export a.h5part -o a.vtp --frame world --time 2");
    assert_true(is_command("export") && count("--frame") == (int)FRAME_WORLD && args_given(&args, "--time"));
    accept("export a.h5part -o a.ply --frame=box");
    assert_true(count("--frame") == (int)FRAME_BOX && !args_given(&args, "--time"));
    accept("devices --watch --record r --device file:a/b.rec");
    assert_true(is_command("devices") && *(const bool *)value_of("--watch"));
    assert_string_equal(text("--record"), "r");
    assert_string_equal(args.device, "file:a/b.rec");
    accept("--device=file:a");
    assert_true(is_command("play"));
    assert_string_equal(args.device, "file:a");
    static const char *const moved[] = {"render s -o o", "run s -o o", "bench s"};
    for (size_t i = 0; i < sizeof moved / sizeof *moved; i++) {
        char line[128];
        snprintf(line, sizeof line, "%s --device file:a --mapping m", moved[i]);
        accept(line);
        assert_string_equal(args.device, "file:a");
        assert_string_equal(args.mapping, "m");
    }
    accept("info -- -odd-name");
    assert_string_equal(args.scenes[0], "-odd-name");
}

static void settings_come_in_order(void **state)
{
    (void)state;
    accept(
        "info s --set a.b=1 --backend cpu --particles 5000 --method=mueller --view none --threads 2 --set c=d=e");
    const char *const expected[] = {"a.b=1",          "solver.backend=cpu", "solver.method=mueller",
                                    "view.kind=none", "solver.threads=2",   "c=d=e"};
    assert_int_equal(args.settings.count, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(args.settings.set[i], expected[i]);
    assert_int_equal(args.settings.particles, 5000);
}

/* As for --particles. */
static void a_swept_number_of_particles(void **state)
{
    (void)state;
    SceneSettings settings = {.count = 0};
    char said[SWEEP_SAID];
    accept("bench --sweep particles=2e3,2.5e1,7");
    static const size_t counts[] = {2000, 25, 7};
    for (int i = 0; i < 3; i++) {
        assert_true(sweep_set("particles", args.sweeps[0].values[i], "--sweep", said, &settings, &error));
        assert_int_equal(settings.particles, counts[i]);
    }
}

static void sweeps_are_split(void **state)
{
    (void)state;
    accept("bench --sweep particles=1024,2048 --sweep backend=cpu --sweep gravity=[0,-1,0],[0,-2,0]");
    assert_int_equal(args.sweep_count, 3);
    assert_string_equal(args.sweeps[0].key, "particles");
    assert_int_equal(args.sweeps[0].count, 2);
    assert_string_equal(args.sweeps[0].values[1], "2048");
    assert_string_equal(args.sweeps[1].key, "solver.backend");
    assert_string_equal(args.sweeps[2].key, "gravity");
    assert_int_equal(args.sweeps[2].count, 2);
    assert_string_equal(args.sweeps[2].values[1], "[0,-2,0]");
    refuse("bench --sweep threads",
           "slosh bench: --sweep takes KEY=A,B,... such as threads=1,2, not 'threads'");
    refuse("bench --sweep threads=1,,2", "slosh bench: --sweep threads=1,,2: a value is empty");
    refuse("bench --sweep threads=1,", "slosh bench: --sweep threads=1,: a value is empty");
    refuse("bench --sweep particles=many",
           "slosh bench: --sweep particles takes whole numbers from 1 on, not 'many'");
    refuse("run s -o o --sweep threads=1", "slosh run: unknown option '--sweep'");
}

static void slips_are_named(void **state)
{
    (void)state;
    refuse("rendr s", "slosh: unknown command 'rendr'; did you mean 'render'?");
    refuse("sim", "slosh: unknown command 'sim'");
    refuse("dance", "slosh: unknown command 'dance'; `slosh help` lists them");
    refuse("render s -o a.png --tme 3", "slosh render: unknown option '--tme'; did you mean '--time'?");
    refuse("render s -o a.png --xyzzy",
           "slosh render: unknown option '--xyzzy'; `slosh help render` lists them");
    refuse("run s -o a --fps 3",
           "slosh run: unknown option '--fps', which is one of slosh render; `slosh help run`");
    refuse("play --time 3", "slosh play: unknown option '--time', which is one of slosh render, run, bench,");
    refuse("dam_brake", "slosh: unknown command 'dam_brake'; did you mean the scene 'dam_break'?");
    refuse("render -o a.png",
           "slosh render: the scene is missing; write slosh render SCENE|IN.h5part|SESSION -o");
    refuse("render s", "slosh render: -o is missing; add -o with OUT.png, OUT.mp4, OUT.gif or a folder");
    refuse("run s", "slosh run: -o is missing; add -o with OUT.h5part");
    refuse("render s t -o a.png", "slosh render: one argument too many: 't'; it takes 1 scene");
    refuse("render s -o", "slosh render: -o needs a value: OUT");
    refuse("info --quiet=1", "slosh info: --quiet takes no value");
    refuse("info --set a.b", "slosh info: --set takes PATH=VALUE such as solver.step.dt=0.01, not 'a.b'");
    refuse("info --set =3", "slosh info: --set takes PATH=VALUE");
    refuse("info --json=", "slosh info: --json needs a name after it, not an empty one");
    refuse("info --backend=", "slosh info: --backend needs a name or number after it");
    refuse("export -o a.ply", "slosh export: the snapshot file is missing; write slosh export IN.h5part -o");
    refuse("export a.h5part",
           "slosh export: -o is missing; add -o with OUT.pvd, OUT.vtp, OUT.ply, OUT.obj, or of a slice");
    refuse("export a.h5part -o a.ply --frame moon",
           "slosh export: --frame must be one of box|world, not 'moon'");
    refuse("export a.h5part -o a.ply --frame wor",
           "slosh export: --frame must be one of box|world, not 'wor'");
    refuse("export a.h5part -o a.ply --set a=1", "slosh export: unknown option '--set'");
    refuse("play --device a.rec",
           "slosh play: --device must be file:PATH, with the path of a recording, not 'a.rec'");
    refuse("devices --device file:", "slosh devices: --device must be file:PATH");
    refuse("devices --device=", "slosh devices: --device must be file:PATH");
    refuse("run s -o o --mapping m", "slosh run: --mapping says what motion devices do; add --device");
    refuse("validate --device file:a", "slosh validate: --device is refused: what is compared moves");
    refuse("chart s -o o.svg --device file:a", "slosh chart: --device is refused: what is compared moves");
    refuse("fit s --error 5 --device file:a", "slosh fit: --device is refused: what is compared moves");
    refuse("replay r --device=file:a", "slosh replay: --device is refused: all that moved the box");
    refuse("export a -o b --device file:a", "slosh export: --device is refused: nothing is simulated");
    refuse("info --device file:a", "slosh info: --device is refused: nothing is simulated");
    refuse("devices a", "slosh devices: one argument too many: 'a'; it takes 0 scenes");
    refuse("bench --clock sun", "slosh bench: --clock must be one of gl|finish, not 'sun'");
}

static void numbers_have_ranges(void **state)
{
    (void)state;
    refuse("run s -o o --time -1", "slosh run: --time must be 0 to 1000000, not -1");
    refuse("run s -o o --time nan", "slosh run: --time must be a number, not 'nan'");
    refuse("run s -o o --time inf", "slosh run: --time must be a number, not 'inf'");
    refuse("run s -o o --time 1e999", "slosh run: --time must be a number, not '1e999'");
    refuse("run s -o o --time 5s", "slosh run: --time must be a number, not '5s'");
    refuse("run s -o o --time=", "slosh run: --time must be a number, not ''");
    refuse("run s -o o --every 0", "slosh run: --every must be more than 0 and at most 1000000, not 0");
    refuse("render s -o o --fps 0", "slosh render: --fps must be 0.001 to 1000, not 0");
    refuse("render s -o o --fps 1e-9", "slosh render: --fps must be 0.001 to 1000, not 1e-9");
    refuse("render s -o o --fps 1001", "slosh render: --fps must be 0.001 to 1000, not 1001");
    refuse("render s -o o --frames 0", "slosh render: --frames must be 1 to 10000000, not 0");
    refuse("render s -o o --frames 1.5", "slosh render: --frames must be a whole number, not '1.5'");
    refuse("info --particles 0", "slosh info: --particles must be 1 to 2147483647, not 0");
    refuse("info --particles 3e9", "slosh info: --particles must be 1 to 2147483647, not 3e9");
    refuse("render s -o o --gpu -1", "slosh render: --gpu must be 0 to 15, not -1");
    accept("render s -o o --frames 1e3 --size 16384x1");
    assert_true(count("--frames") == 1000 && args.width == 16384 && args.height == 1);
}

static void sizes_have_two_sides(void **state)
{
    (void)state;
    static const char *const odd[] = {"640", "640x", "x480", "640x480x3", "-1x5", "axb", "640X480", "1e3x2"};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        char line[64], message[128];
        snprintf(line, sizeof line, "bench --size %s", odd[i]);
        snprintf(message, sizeof message, "slosh bench: --size must be WxH such as 1280x720, not '%s'",
                 odd[i]);
        refuse(line, message);
    }
    refuse("bench --size 0x5", "slosh bench: --size must be 1 to 16384 pixels each way, not '0x5'");
    refuse("bench --size 5x16385", "slosh bench: --size must be 1 to 16384 pixels each way");
}

static void too_many_are_refused(void **state)
{
    (void)state;
    char *argv[2 * SCENE_SETTINGS_MAX + 8] = {"slosh", "info"};
    int argc = 2;
    for (int i = 0; i <= SCENE_SETTINGS_MAX; i++) {
        argv[argc++] = "--set";
        argv[argc++] = "a=1";
    }
    args_free(&args);
    assert_true(args_parse(cli_commands, argc - 2, argv, &args, &error));
    args_free(&args);
    assert_false(args_parse(cli_commands, argc, argv, &args, &error));
    assert_non_null(strstr(error.message, "more than 64 settings"));
    char huge[4096];
    memset(huge, 'x', sizeof huge);
    memcpy(huge, "a=", 2);
    huge[sizeof huge - 1] = 0;
    argv[3] = huge;
    args_free(&args);
    assert_false(args_parse(cli_commands, 4, argv, &args, &error));
    assert_non_null(strstr(error.message, "--set: too long"));
}

/* `slosh [play] [SCENE]` */
static void play_is_what_is_meant_without_a_command(void **state)
{
    (void)state;
    static const char *const lines[] = {"",         "play",    "play a.yaml",  "a.yaml",
                                        "folder/a", "--quiet", "--quiet -- a", "dam_break"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        accept(lines[i]);
        assert_true(is_command("play"));
        assert_int_equal(args.width, 1280);
    }
    accept("x/y.yaml --set gravity=[0,0,0] --record r");
    assert_string_equal(args.scenes[0], "x/y.yaml");
    assert_string_equal(text("--record"), "r");
    assert_int_equal(args.settings.count, 1);
    accept("a.recording"); /* the loader names the command */
    assert_true(is_command("play"));
    accept("bench --play --seconds 3 a");
    assert_true(options_of_bench(&args)->play && number("--seconds") == 3);
    refuse("play a b", "slosh play: one argument too many");
    refuse("--fps 3", "slosh play: unknown option '--fps'");
    refuse("bench --seconds 0", "slosh bench:");
}

static char *help_of(const char *command)
{
    char *help = NULL;
    size_t size;
    FILE *file = open_memstream(&help, &size);
    cli_help(command ? command_find(cli_commands, command) : NULL, file);
    fclose(file);
    return help;
}

static void help_comes_from_the_table(void **state)
{
    (void)state;
    accept("help");
    assert_true(is_command("help") && args.scene_count == 0);
    accept("--help");
    assert_true(is_command("help") && args.scene_count == 0);
    accept("help bench");
    assert_true(is_command("help") && args.scene_count == 1);
    accept("render --help");
    assert_true(args.help && is_command("render"));
    accept("run -h");
    assert_true(args.help && is_command("run"));
    accept("--version");
    assert_null(args.command);
    assert_false(command_unknown(cli_commands, "dance", &error));
    assert_string_equal(error.message,
                        "slosh: unknown command 'dance'; `slosh help` lists them, and the scenes");

    char *program = help_of(NULL), *bench = help_of("bench"), *run = help_of("run");
    assert_non_null(strstr(program, " SCENE|IN.h5part|SESSION -o OUT.png|OUT.mp4|OUT.gif|FOLDER"));
    assert_non_null(strstr(program, "slosh play"));
    assert_non_null(strstr(program, "dam_break, dam_break_2d, drop,"));
    assert_non_null(strstr(bench, "--sweep KEY=A,B,..."));
    assert_non_null(strstr(bench, "--clock gl|finish"));
    assert_non_null(strstr(run, "--every S"));
    assert_null(strstr(run, "--fps"));
    assert_non_null(strstr(run, "--device file:PATH     a recording of motion devices"));
    assert_non_null(strstr(bench, "--mapping FILE"));
    free(program);
    free(bench);
    free(run);
}

/* A valid value for each option, by kind or name; NULL: no value needed. */
static const char *value_for(const OptionRow *option)
{
    static const char *const named[][2] = {{"--cell", "1"}, {"--level", "0.5"}, {"--device", "file:a"}};
    static char choice[32];
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (strcmp(option->name, named[i][0]) == 0)
            return named[i][1];
    switch (option->kind) {
    case OPTION_SIZE:
        return "64x64";
    case OPTION_CHOICE:
        snprintf(choice, sizeof choice, "%.*s", (int)strcspn(option->value, "|"), option->value);
        return choice;
    case OPTION_SETTING:
        return option->path ? "cpu" : "a=1";
    case OPTION_SWEEP:
        return "a=1";
    default:
        return option->value ? "1" : NULL;
    }
}

/* True if the command takes the option, on a line with all other required arguments. */
static bool takes(const Command *command, const OptionRow *option)
{
    char line[256];
    const char *value = value_for(option);
    const bool wants_output = command->output && strcmp(option->name, "-o") != 0;
    snprintf(line, sizeof line, "%s %s %s %s %s %s", command->name, command->takes_min ? "s" : "",
             wants_output ? "-o o" : "", option->needs ? "--device file:a" : "", option->name,
             value ? value : "");
    if (parse(line))
        return true;
    if (!strstr(error.message, "unknown option") && !strstr(error.message, "is refused") &&
        !strstr(error.message, "makes no sense"))
        fail_msg("%s: %s", line, error.message);
    return false;
}

static const OptionRow *row_of(const Command *command, const char *name)
{
    const OptionRow *row = command->options;
    while (row->name && strcmp(row->name, name) != 0)
        row++;
    return row->name ? row : NULL;
}

static void help_lists_what_is_taken_and_nothing_else(void **state)
{
    (void)state;
    int taken = 0, refused = 0;
    for (CommandList at = cli_commands; *at; at++) {
        char *help = help_of((*at)->name);
        for (CommandList other = cli_commands; *other; other++)
            for (const OptionRow *option = (*other)->options; option->name; option++) {
                const OptionRow *own = row_of(*at, option->name);
                char listed[64];
                snprintf(listed, sizeof listed, "\n  %s ", option->name);
                const bool lists = strstr(help, listed) != NULL;
                if (takes(*at, own ? own : option) != lists)
                    fail_msg("slosh %s %s is %s", (*at)->name, option->name,
                             lists ? "listed and refused" : "taken and not listed");
                taken += lists;
                refused += !lists;
            }
        assert_null(strstr(help, "refused"));
        free(help);
    }
    assert_true(taken > 100 && refused > 50);
}

/* A command's table fits the bits of Args.given, names no option twice, and asks for options that are there.
 */
static void tables_are_whole(void **state)
{
    (void)state;
    for (CommandList at = cli_commands; *at; at++) {
        assert_true((*at)->name && (*at)->usage && (*at)->help && (*at)->takes && (*at)->run);
        const OptionRow *options = (*at)->options;
        int rows = 0;
        for (; options[rows].name; rows++) {
            assert_ptr_equal(row_of(*at, options[rows].name), &options[rows]);
            assert_true(!options[rows].needs || row_of(*at, options[rows].needs));
            assert_true(!(options[rows].flags & OPTION_OWN) || options[rows].offset < (*at)->own_size);
        }
        assert_true(rows <= 64);
    }
}

/* Names for --backend and similar options come from the lists of the scene's keys. */
static void help_names_what_there_is(void **state)
{
    (void)state;
    char *bench = help_of("bench"), *play = help_of("play");
    for (int i = 0; bench_table_choice(i); i++)
        assert_non_null(strstr(bench, bench_table_choice(i)));
    assert_non_null(strstr(play, "the equations of the solver: mueller, wcsph, dfsph, pbf\n"));
    assert_non_null(strstr(play, "pixels (1280x720)\n"));
    assert_non_null(strstr(bench, "pixels (512x512)\n"));
    free(bench);
    free(play);
}

/* Messages name the option, not the key behind the option. */
static void options_keep_their_words(void **state)
{
    (void)state;
    accept("info s --backend cuda --set a=1 --threads=many");
    assert_string_equal(args.settings.said[0], "--backend cuda");
    assert_null(args.settings.said[1]);
    assert_string_equal(args.settings.said[2], "--threads many");
}

static void a_command_of_ones_own(void **state)
{
    (void)state;
    const Command *const list[] = {&command_toy, NULL};
    char *plain[] = {"slosh", "toy"}, *full[] = {"slosh", "toy", "--sides", "12", "--word", "ab", "--word=c"};
    args_free(&args);
    assert_true(args_parse(list, 2, plain, &args, &error));
    assert_int_equal(args.command->run(&args), 0);
    assert_int_equal(toy_sum, 6);
    args_free(&args);
    assert_true(args_parse(list, 7, full, &args, &error));
    assert_true(args_given(&args, "--word") && !args_given(&args, "--quiet"));
    args.command->run(&args);
    assert_int_equal(toy_sum, 15);
    command_add(&command_toy);
    accept("toy");
    assert_true(is_command("toy"));
    full[3] = "21";
    args_free(&args);
    assert_false(args_parse(list, 7, full, &args, &error));
    assert_string_equal(error.message, "slosh toy: --sides must be 2 to 20, not 21");
    args_free(&args);
}

int main(void)
{
    backends_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults),
        cmocka_unit_test(every_option_reaches_its_field),
        cmocka_unit_test(settings_come_in_order),
        cmocka_unit_test(a_swept_number_of_particles),
        cmocka_unit_test(sweeps_are_split),
        cmocka_unit_test(slips_are_named),
        cmocka_unit_test(numbers_have_ranges),
        cmocka_unit_test(sizes_have_two_sides),
        cmocka_unit_test(too_many_are_refused),
        cmocka_unit_test(play_is_what_is_meant_without_a_command),
        cmocka_unit_test(help_comes_from_the_table),
        cmocka_unit_test(tables_are_whole),
        cmocka_unit_test(help_lists_what_is_taken_and_nothing_else),
        cmocka_unit_test(help_names_what_there_is),
        cmocka_unit_test(options_keep_their_words),
        cmocka_unit_test(a_command_of_ones_own), /* the last: it stays in the list */
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
