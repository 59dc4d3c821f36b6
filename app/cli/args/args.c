#include "app/cli/args/args.h"

#include "app/base/program.h"
#include "app/scene/scene.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Parser state: reads a command line into Args. */
typedef struct ArgsParser {
    CommandList commands;
    int argc, at; /* `at`: index of the next argument */
    char *const *argv;
    const Command *command; /* NULL: not known yet */
    Args *args;
    Error *error;
} ArgsParser;

/* Sets the error "slosh render: message"; returns false. */
__attribute__((format(printf, 2, 3))) static bool fail(const ArgsParser *parser, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return error_set(parser->error, "slosh%s%s: %s", parser->command ? " " : "",
                     parser->command ? parser->command->name : "", what);
}

static void *field(const ArgsParser *parser, const OptionRow *option)
{
    void *owner = option->flags & OPTION_OWN ? parser->args->own : parser->args;
    return (char *)owner + option->offset;
}

/* Copies a text into the pool of the Args; the copy lives as long as the Args. Returns NULL if the pool is
   full. */
static char *keep(Args *args, const char *text, size_t length)
{
    if (length >= sizeof args->pool - args->pool_used)
        return NULL;
    char *copy = args->pool + args->pool_used;
    memcpy(copy, text, length);
    copy[length] = 0;
    args->pool_used += length + 1;
    return copy;
}

/* Keeps the text "--backend cuda". */
static const char *keep_said(Args *args, const char *option, const char *value)
{
    char said[512];
    const int length = snprintf(said, sizeof said, "%s %s", option, value);
    return length < (int)sizeof said ? keep(args, said, (size_t)length) : NULL;
}

static bool number_parse(const char *text, double *out)
{
    char *end;
    if (!*text || text[strspn(text, "0123456789.eE+-")])
        return false;
    *out = strtod(text, &end);
    return !*end && isfinite(*out);
}

static bool parse_number(const ArgsParser *parser, const OptionRow *option, const char *text, bool whole,
                         double *out)
{
    const bool open = option->flags & OPTION_OPEN_LOW;
    if (!number_parse(text, out) || (whole && *out != floor(*out)))
        return fail(parser, "%s must be a %s, not '%.60s'", option->name, whole ? "whole number" : "number",
                    text);
    if ((open ? *out > option->min : *out >= option->min) && *out <= option->max)
        return true;
    return fail(parser, "%s must be %s%g%s%.10g, not %.60s", option->name, open ? "more than " : "",
                option->min, open ? " and at most " : " to ", option->max, text);
}

static bool parse_size(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    int *size = field(parser, option); /* width, then height */
    const char *cross = strchr(text, 'x');
    if (!cross || text[strspn(text, "0123456789x")] || cross == text || !cross[1] || strchr(cross + 1, 'x'))
        return fail(parser, "%s must be WxH such as 1280x720, not '%.60s'", option->name, text);
    const double width = (double)strtol(text, NULL, 10), height = (double)strtol(cross + 1, NULL, 10);
    if (width < option->min || height < option->min || width > option->max || height > option->max)
        return fail(parser, "%s must be %g to %g pixels each way, not '%.60s'", option->name, option->min,
                    option->max, text);
    size[0] = (int)width;
    size[1] = (int)height;
    return true;
}

/* Parses one name of "a|b|c"; stores `min` plus the index of the name. */
static bool parse_choice(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    const char *name = option->value;
    for (int value = (int)option->min;; value++) {
        const size_t length = strcspn(name, "|");
        if (strlen(text) == length && strncmp(text, name, length) == 0) {
            *(int *)field(parser, option) = value;
            return true;
        }
        if (!name[length])
            return fail(parser, "%s must be one of %s, not '%.60s'", option->name, option->value, text);
        name += length + 1;
    }
}

static bool parse_setting(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    SceneSettings *settings = &parser->args->settings;
    char whole[512];
    const char *equals = strchr(text, '=');
    if (!option->path && (!equals || equals == text))
        return fail(parser, "--set takes PATH=VALUE such as solver.step.dt=0.01, not '%.60s'", text);
    if (option->path && !*text)
        return fail(parser, "%s needs a name or number after it", option->name);
    if (settings->count == SCENE_SETTINGS_MAX)
        return fail(parser, "more than %d settings; write them into the scene file", SCENE_SETTINGS_MAX);
    const int length = option->path ? snprintf(whole, sizeof whole, "%s=%s", option->path, text)
                                    : snprintf(whole, sizeof whole, "%s", text);
    const char *kept = length < (int)sizeof whole ? keep(parser->args, whole, (size_t)length) : NULL;
    const char *said = kept && option->path ? keep_said(parser->args, option->name, text) : NULL;
    if (!kept || (option->path && !said))
        return fail(parser, "%s: too long; write it into the scene file", option->name);
    settings->said[settings->count] = said;
    settings->set[settings->count++] = kept;
    return true;
}

/* Full path of a sweep key: "backend" stands for "solver.backend", as in --backend of any command; side by
   side, "time" is the time of the shown state. */
static const char *sweep_key(CommandList commands, const OptionRow *sweep, const char *name)
{
    if (strcmp(sweep->name, "--compare") == 0 && strcmp(name, "time") == 0)
        return "view.time";
    for (CommandList at = commands; *at; at++)
        for (const OptionRow *option = (*at)->options; option->name; option++)
            if (option->path && strcmp(option->name + 2, name) == 0)
                return option->path;
    return name;
}

/* Length of the first value of "a,b,c"; commas within brackets belong to the value. */
static size_t value_length(const char *text)
{
    int depth = 0;
    size_t length = 0;
    for (; text[length] && (depth > 0 || text[length] != ','); length++)
        depth += (text[length] == '[' || text[length] == '{') - (text[length] == ']' || text[length] == '}');
    return length;
}

static bool parse_sweep(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    Args *args = parser->args;
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1])
        return fail(parser, "%s takes KEY=A,B,... such as threads=1,2, not '%.60s'", option->name, text);
    if (args->sweep_count == ARGS_SWEEPS_MAX)
        return fail(parser, "more than %d times %s; use fewer", ARGS_SWEEPS_MAX, option->name);
    Sweep *sweep = &args->sweeps[args->sweep_count++];
    const char *name = keep(args, text, (size_t)(equals - text));
    sweep->key = name ? sweep_key(parser->commands, option, name) : NULL;
    sweep->typed = name;
    for (const char *at = equals; *at; at += value_length(at)) {
        at++; /* the '=' or a comma */
        const size_t length = value_length(at);
        const char *value = keep(args, at, length);
        if (!name || !value || sweep->count == ARGS_SWEEP_VALUES_MAX)
            return fail(parser, "%s %.60s: too long; use fewer values", option->name, text);
        double count;
        if (strcmp(name, "particles") == 0 &&
            !(number_parse(value, &count) && count >= 1 && count < 0x1p31 && count == floor(count)))
            return fail(parser, "%s particles takes whole numbers from 1 on, not '%.60s'", option->name,
                        value);
        if (length == 0)
            return fail(parser, "%s %.60s: a value is empty; write KEY=A,B,...", option->name, text);
        sweep->values[sweep->count++] = value;
    }
    return true;
}

/* Adds a text to a list. */
static bool parse_list(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    const char **list = field(parser, option);
    int count = 0;
    while (list[count])
        count++;
    if (count == ARGS_LIST_MAX - 1)
        return fail(parser, "more than %d times %s; use fewer", ARGS_LIST_MAX - 1, option->name);
    list[count] = text;
    return true;
}

static bool parse_device(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    *(const char **)field(parser, option) = text;
    return (strncmp(text, "file:", 5) == 0 && text[5]) ||
           fail(parser, "%s must be file:PATH, with the path of a recording, not '%.60s'", option->name,
                text);
}

static bool parse_value(const ArgsParser *parser, const OptionRow *option, const char *text)
{
    void *out = field(parser, option);
    double number;
    switch (option->kind) {
    case OPTION_TEXT:
        *(const char **)out = text;
        return *text || fail(parser, "%s needs a name after it, not an empty one", option->name);
    case OPTION_NUMBER:
        return parse_number(parser, option, text, false, out);
    case OPTION_COUNT:
        if (!parse_number(parser, option, text, true, &number))
            return false;
        *(int *)out = (int)number;
        return true;
    case OPTION_PARTICLES:
        if (!parse_number(parser, option, text, true, &number))
            return false;
        *(size_t *)out = (size_t)number;
        return true;
    case OPTION_SIZE:
        return parse_size(parser, option, text);
    case OPTION_CHOICE:
        return parse_choice(parser, option, text);
    case OPTION_SETTING:
        return parse_setting(parser, option, text);
    case OPTION_SWEEP:
        return parse_sweep(parser, option, text);
    case OPTION_LIST:
        return parse_list(parser, option, text);
    case OPTION_DEVICE:
        return parse_device(parser, option, text);
    case OPTION_FLAG:
    case OPTION_REFUSED:
    case OPTION_HELP:
        break;
    }
    return false;
}

static const OptionRow *option_find(const Command *command, const char *name)
{
    for (const OptionRow *option = command->options; option->name; option++)
        if (strcmp(option->name, name) == 0)
            return option;
    return NULL;
}

/* Lists the commands that take the option: "render, run". */
static void list_takers(CommandList list, const char *name, char commands[128])
{
    size_t used = 0;
    for (CommandList at = list; *at && used < 128; at++) {
        const OptionRow *option = option_find(*at, name);
        if (option && option->kind != OPTION_REFUSED)
            used += (size_t)snprintf(commands + used, 128 - used, "%s%s", used ? ", " : "", (*at)->name);
    }
}

static bool unknown_option(const ArgsParser *parser, const char *name)
{
    char takers[128] = "";
    list_takers(parser->commands, name, takers);
    if (*takers)
        return fail(parser, "unknown option '%.60s', which is one of slosh %s; `slosh help %s` lists its own",
                    name, takers, parser->command->name);
    Suggestion near = suggest_for(name);
    for (const OptionRow *option = parser->command->options; option->name; option++)
        suggest_offer(&near, option->name);
    if (near.best)
        return fail(parser, "unknown option '%.60s'; did you mean '%s'?", name, near.best);
    return fail(parser, "unknown option '%.60s'; `slosh help %s` lists them", name, parser->command->name);
}

/* Parses an option from the argument just read: "--name", "--name=value" or "--name" before its value. */
static bool parse_option(ArgsParser *parser, const char *argument)
{
    char name[64];
    const char *equals = strncmp(argument, "--", 2) == 0 ? strchr(argument, '=') : NULL;
    const size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    snprintf(name, sizeof name, "%.*s", (int)length, argument);
    const OptionRow *option = option_find(parser->command, strcmp(name, "-h") == 0 ? "--help" : name);
    if (!option)
        return unknown_option(parser, name);
    if (option->kind == OPTION_REFUSED)
        return fail(parser, "%s is %s", name, option->help);
    if (!option->value && equals)
        return fail(parser, "%s takes no value", name);
    if (option->kind == OPTION_FLAG)
        *(bool *)field(parser, option) = true;
    if (option->kind == OPTION_HELP)
        parser->args->help = true;
    parser->args->given |= UINT64_C(1) << (option - parser->command->options);
    if (!option->value)
        return true;
    if (!equals && parser->at == parser->argc)
        return fail(parser, "%s needs a value: %s", name, option->value);
    return parse_value(parser, option, equals ? equals + 1 : parser->argv[parser->at++]);
}

static bool parse_scene(const ArgsParser *parser, const char *name)
{
    Args *args = parser->args;
    if (args->scene_count == parser->command->takes_max)
        return fail(parser, "one argument too many: '%.60s'; it takes %d %s%s", name, args->scene_count,
                    parser->command->takes, args->scene_count == 1 ? "" : "s");
    args->scenes[args->scene_count++] = name;
    return true;
}

const Command *command_find(CommandList commands, const char *name)
{
    while (*commands && strcmp((*commands)->name, name) != 0)
        commands++;
    return *commands;
}

bool command_unknown(CommandList commands, const char *name, Error *error)
{
    Suggestion near = suggest_for(name);
    for (CommandList at = commands; *at; at++)
        suggest_offer(&near, (*at)->name);
    if (near.best)
        return error_set(error, "slosh: unknown command '%.60s'; did you mean '%s'?", name, near.best);
    SceneNames scenes;
    scene_path_names(&scenes);
    for (int i = 0; i < scenes.count; i++)
        suggest_offer(&near, scenes.name[i]);
    if (near.best)
        return error_set(error, "slosh: unknown command '%.60s'; did you mean the scene '%s'?", name,
                         near.best);
    return error_set(error, "slosh: unknown command '%.60s'; `slosh help` lists them, and the scenes", name);
}

/* True if the word names a scene of slosh: "dam_break". */
static bool is_scene(const char *word)
{
    char path[SCENE_PATH_SIZE];
    Error none;
    const char *dot = scene_path_find(word, path, &none) ? strrchr(path, '.') : NULL;
    return dot && strcmp(dot, ".yaml") == 0;
}

/* True if the word is an option or a scene in place of a command. */
static bool is_for_play(const char *word)
{
    return word[0] == '-' || strchr(word, '/') || strchr(word, '.') || is_scene(word);
}

/* Prepares Args for the command: initial values of all options. */
static bool begin_command(ArgsParser *parser, const Command *command)
{
    Args *args = parser->args;
    parser->command = args->command = command;
    args->width = command->width;
    args->height = command->height;
    if (command->own_size > 0 && !(args->own = calloc(1, command->own_size)))
        return fail(parser, "out of memory");
    for (const OptionRow *option = command->options; option->name; option++)
        if (option->kind == OPTION_NUMBER)
            *(double *)field(parser, option) = option->initial;
        else if (option->kind == OPTION_COUNT)
            *(int *)field(parser, option) = (int)option->initial;
    return true;
}

static bool parse_command(ArgsParser *parser)
{
    const char *name = parser->at < parser->argc ? parser->argv[parser->at++] : parser->commands[0]->name;
    if (strcmp(name, "--version") == 0)
        return true;
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        name = "help";
    const Command *command = command_find(parser->commands, name);
    if (!command && !is_for_play(name))
        return command_unknown(parser->commands, name, parser->error);
    parser->at -= !command;
    return begin_command(parser, command ? command : parser->commands[0]);
}

/* Checks the options together, and for missing ones. */
static bool check_whole(const ArgsParser *parser)
{
    const Args *args = parser->args;
    const Command *command = parser->command;
    if (args->scene_count < command->takes_min)
        return fail(parser, "the %s is missing; write slosh %s %s", command->takes, command->name,
                    command->usage);
    if (command->output && !args->output)
        return fail(parser, "-o is missing; add -o with %s", command->output);
    for (const OptionRow *option = command->options; option->name; option++)
        if (option->needs && args_given(args, option->name) && !args_given(args, option->needs))
            return fail(parser, "%s %s", option->name, option->needs_why);
    return true;
}

static bool parse_rest(ArgsParser *parser)
{
    bool options = true;
    while (parser->at < parser->argc) {
        const char *argument = parser->argv[parser->at++];
        if (options && strcmp(argument, "--") == 0)
            options = false;
        else if (!(options && argument[0] == '-' && argument[1] ? parse_option(parser, argument)
                                                                : parse_scene(parser, argument)))
            return false;
    }
    return parser->args->help || check_whole(parser);
}

bool args_parse(CommandList commands, int argc, char *const argv[], Args *args, Error *error)
{
    memset(args, 0, sizeof *args);
    args->gpu = -1;
    ArgsParser parser = {
        .commands = commands, .argc = argc, .at = 1, .argv = argv, .args = args, .error = error};
    return parse_command(&parser) && (!parser.command || parse_rest(&parser));
}

void args_free(Args *args)
{
    free(args->own);
    args->own = NULL;
}

bool args_given(const Args *args, const char *option)
{
    const OptionRow *row = args->command ? option_find(args->command, option) : NULL;
    return row && args->given >> (row - args->command->options) & 1;
}

const char *args_text(const Args *args, const OptionRow *row)
{
    const void *owner = row->flags & OPTION_OWN ? args->own : args;
    return *(const char *const *)((const char *)owner + row->offset);
}
