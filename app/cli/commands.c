#include "app/cli/cli.h"

#include "app/cli/cli_private.h"
#include "app/cli/command_list.h"
#include "app/input/actions.h"
#include "app/scene/scene.h"

#include <assert.h>
#include <string.h>

#define X(name) extern const Command command_##name;
COMMANDS(X)
#undef X

#define X(name) +1
enum { COMMAND_COUNT = COMMANDS(X), ADDED_MAX = 8 };
#undef X

/* Ends with NULL. */
#define X(name) &command_##name,
static const Command *list[COMMAND_COUNT + ADDED_MAX + 1] = {COMMANDS(X)};
#undef X

const CommandList cli_commands = list;

void command_add(const Command *command)
{
    size_t count = 0;
    while (list[count])
        count++;
    assert(count < COMMAND_COUNT + ADDED_MAX);
    list[count] = command;
}

const HelpTopic help_topics[] = {
    {"keys", "every key of a scene", scene_keys_print},
    {"window", "what keys, mouse and gamepad do in the window", user_actions_print},
    {"presets", "settings that go together, for --preset", preset_print},
    {"man", NULL, manual_print},
    {"bash", NULL, completion_print_bash},
    {"zsh", NULL, completion_print_zsh},
    {0},
};

static void help_program(FILE *file)
{
    fprintf(file, "slosh: a fluid of particles, simulated, shown and measured\n\n");
    for (CommandList at = cli_commands; *at; at++)
        fprintf(file, "  slosh %-9s %-44s %s\n", (*at)->name, (*at)->usage, (*at)->help);
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

void cli_help(const Command *command, FILE *file)
{
    if (!command) {
        help_program(file);
        return;
    }
    fprintf(file, "slosh %s %s\n%s\n\n", command->name, command->usage, command->help);
    for (const OptionRow *option = command->options; option->name; option++) {
        char left[64], words[OPTION_WORDS_SIZE];
        if (option->kind == OPTION_REFUSED)
            continue;
        snprintf(left, sizeof left, "%s %s", option->name, option->value ? option->value : "");
        option_words(command, option, words, sizeof words);
        fprintf(file, "  %-22s %s\n", left, words);
    }
}

/* slosh help: of a command, a topic or the program. */

static int help(const Args *args)
{
    const char *name = args->scene_count > 0 ? args->scenes[0] : "help";
    const Command *command = command_find(cli_commands, name);
    const HelpTopic *topic = help_topics;
    Error error;
    while (topic->name && strcmp(topic->name, name) != 0)
        topic++;
    if (topic->name)
        topic->print(stdout);
    else if (command)
        cli_help(command == args->command ? NULL : command, stdout);
    else {
        command_unknown(cli_commands, name, &error);
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    return 0;
}

static const OptionRow no_options[] = {{0}};

const Command command_help = {
    .name = "help",
    .usage = "[COMMAND|keys|window|presets]",
    .help = "says what a command does and takes",
    .takes = "command",
    .takes_max = 1,
    .options = no_options,
    .run = help,
};
