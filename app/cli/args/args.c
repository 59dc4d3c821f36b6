#include "app/cli/args/args.h"

#include "app/base/program.h"
#include "app/scene/scene_files.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Parser state: reads a command line into Args. */
typedef struct Parser {
    const ArgsTable *table;
    int argc, at; /* `at`: index of the next argument */
    char *const *argv;
    const CommandRow *row;
    Args *args;
    Error *error;
} Parser;

/* Sets the error "slosh render: message"; returns false. */
__attribute__((format(printf, 2, 3))) static bool fail(const Parser *parser, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return error_set(parser->error, "slosh%s%s: %s", parser->row ? " " : "",
                     parser->row ? parser->row->name : "", what);
}

static void *field(const Parser *parser, const OptionRow *option)
{
    return (char *)parser->args + option->offset;
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

static bool parse_number(const Parser *parser, const OptionRow *option, const char *text, bool whole,
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

static bool parse_size(const Parser *parser, const OptionRow *option, const char *text)
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
    parser->args->size_given = true;
    return true;
}

/* Parses one name of "a|b|c"; stores `min` plus the index of the name. */
static bool parse_choice(const Parser *parser, const OptionRow *option, const char *text)
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

static bool parse_setting(const Parser *parser, const OptionRow *option, const char *text)
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

/* Full path of a sweep key: "backend" stands for "solver.backend", as in --backend. */
static const char *sweep_key(const ArgsTable *table, const char *name)
{
    for (const OptionRow *option = table->options; option->name; option++)
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

static bool parse_sweep(const Parser *parser, const OptionRow *option, const char *text)
{
    Args *args = parser->args;
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1])
        return fail(parser, "%s takes KEY=A,B,... such as threads=1,2, not '%.60s'", option->name, text);
    if (args->sweep_count == ARGS_SWEEPS_MAX)
        return fail(parser, "more than %d times %s; use fewer", ARGS_SWEEPS_MAX, option->name);
    Sweep *sweep = &args->sweeps[args->sweep_count++];
    const char *name = keep(args, text, (size_t)(equals - text));
    sweep->key = name ? sweep_key(parser->table, name) : NULL;
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

static bool parse_axis(const Parser *parser, const char *text)
{
    Args *args = parser->args;
    if (args->axis_count == ARGS_AXES_MAX)
        return fail(parser, "more than %d times --axis; use fewer", ARGS_AXES_MAX);
    args->axes[args->axis_count++] = text;
    return true;
}

static bool parse_device(const Parser *parser, const OptionRow *option, const char *text)
{
    *(const char **)field(parser, option) = text;
    return (strncmp(text, "file:", 5) == 0 && text[5]) ||
           fail(parser, "%s must be file:PATH, with the path of a recording, not '%.60s'", option->name,
                text);
}

static bool parse_value(const Parser *parser, const OptionRow *option, const char *text)
{
    void *out = field(parser, option);
    double number;
    switch (option->kind) {
    case OPTION_TEXT:
        *(const char **)out = text;
        return *text || fail(parser, "%s needs a name after it, not an empty one", option->name);
    case OPTION_NUMBER:
        parser->args->time_given |= strcmp(option->name, "--time") == 0;
        parser->args->past_given |= strcmp(option->name, "--past") == 0;
        parser->args->seconds_given |= strcmp(option->name, "--seconds") == 0;
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
    case OPTION_AXIS:
        return parse_axis(parser, text);
    case OPTION_DEVICE:
        return parse_device(parser, option, text);
    case OPTION_FLAG:
    case OPTION_REFUSED:
    case OPTION_HELP:
        break;
    }
    return false;
}

static const OptionRow *option_find(const Parser *parser, const char *name)
{
    for (const OptionRow *option = parser->table->options; option->name; option++)
        if (option->commands & 1u << parser->row->command && strcmp(option->name, name) == 0)
            return option;
    return NULL;
}

/* Lists the commands that take the option: "render, run". */
static void who_takes(const ArgsTable *table, const char *name, char commands[128])
{
    size_t used = 0;
    for (const CommandRow *row = table->commands; row->name; row++)
        for (const OptionRow *option = table->options; option->name; option++)
            if (option->commands & 1u << row->command && option->kind != OPTION_REFUSED &&
                strcmp(option->name, name) == 0 && used < 128)
                used += (size_t)snprintf(commands + used, 128 - used, "%s%s", used ? ", " : "", row->name);
}

static bool unknown_option(const Parser *parser, const char *name)
{
    char commands[128] = "";
    who_takes(parser->table, name, commands);
    if (*commands)
        return fail(parser, "unknown option '%.60s', which is one of slosh %s; `slosh help %s` lists its own",
                    name, commands, parser->row->name);
    Suggestion near = suggest_for(name);
    for (const OptionRow *option = parser->table->options; option->name; option++)
        if (option->commands & 1u << parser->row->command)
            suggest_offer(&near, option->name);
    if (near.best)
        return fail(parser, "unknown option '%.60s'; did you mean '%s'?", name, near.best);
    return fail(parser, "unknown option '%.60s'; `slosh help %s` lists them", name, parser->row->name);
}

/* Parses an option from the argument just read: "--name", "--name=value" or "--name" before its value. */
static bool parse_option(Parser *parser, const char *argument)
{
    char name[64];
    const char *equals = strncmp(argument, "--", 2) == 0 ? strchr(argument, '=') : NULL;
    const size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    snprintf(name, sizeof name, "%.*s", (int)length, argument);
    const OptionRow *option = option_find(parser, strcmp(name, "-h") == 0 ? "--help" : name);
    if (!option)
        return unknown_option(parser, name);
    if (option->kind == OPTION_REFUSED)
        return fail(parser, "%s is %s", name, option->help);
    if (!option->value && equals)
        return fail(parser, "%s takes no value", name);
    if (option->kind == OPTION_FLAG)
        *(bool *)field(parser, option) = true;
    if (option->kind == OPTION_HELP)
        parser->args->command = COMMAND_HELP;
    if (!option->value)
        return true;
    if (!equals && parser->at == parser->argc)
        return fail(parser, "%s needs a value: %s", name, option->value);
    return parse_value(parser, option, equals ? equals + 1 : parser->argv[parser->at++]);
}

/* Noun for the arguments of a command. */
static const char *takes(const CommandRow *row)
{
    return row->command == COMMAND_REPLAY     ? "recording"
           : row->command == COMMAND_EXPORT   ? "snapshot file"
           : row->command == COMMAND_VALIDATE ? "case"
           : row->command == COMMAND_CHART    ? "scene or case"
           : row->command == COMMAND_SCENES   ? "folder"
           : row->command == COMMAND_NEW      ? "new scene"
                                              : "scene";
}

static bool parse_scene(const Parser *parser, const char *name)
{
    Args *args = parser->args;
    if (args->scene_count == parser->row->scenes_max)
        return fail(parser, "one argument too many: '%.60s'; it takes %d %s%s", name, args->scene_count,
                    takes(parser->row), args->scene_count == 1 ? "" : "s");
    args->scenes[args->scene_count++] = name;
    return true;
}

static const CommandRow *command_find(const ArgsTable *table, const char *name)
{
    for (const CommandRow *row = table->commands; row->name; row++)
        if (strcmp(row->name, name) == 0)
            return row;
    return NULL;
}

static bool unknown_command(const Parser *parser, const char *name)
{
    Suggestion near = suggest_for(name);
    for (const CommandRow *row = parser->table->commands; row->name; row++)
        suggest_offer(&near, row->name);
    if (near.best)
        return fail(parser, "unknown command '%.60s'; did you mean '%s'?", name, near.best);
    SceneNames scenes;
    scene_path_names(&scenes);
    for (int i = 0; i < scenes.count; i++)
        suggest_offer(&near, scenes.name[i]);
    if (near.best)
        return fail(parser, "unknown command '%.60s'; did you mean the scene '%s'?", name, near.best);
    return fail(parser, "unknown command '%.60s'; `slosh help` lists them, and the scenes", name);
}

static const HelpTopic *topic_find(const ArgsTable *table, const char *name)
{
    for (const HelpTopic *topic = table->topics; topic->name; topic++)
        if (strcmp(topic->name, name) == 0)
            return topic;
    return NULL;
}

/* `slosh help [COMMAND|TOPIC]` */
static bool parse_help(Parser *parser)
{
    if (parser->at == parser->argc)
        return true;
    const char *name = parser->argv[parser->at++];
    const CommandRow *row = command_find(parser->table, name);
    const HelpTopic *topic = topic_find(parser->table, name);
    parser->row = NULL;
    if (!row && !topic)
        return unknown_command(parser, name);
    if (parser->at < parser->argc)
        return fail(parser, "one argument too many: '%.60s'; write slosh help COMMAND",
                    parser->argv[parser->at]);
    parser->args->help_for = row ? row->command : COMMAND_HELP;
    parser->args->help_topic = topic;
    return true;
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

static bool parse_command(Parser *parser)
{
    const char *name = parser->at < parser->argc ? parser->argv[parser->at++] : "play";
    if (strcmp(name, "--version") == 0) {
        parser->args->command = COMMAND_VERSION;
        return true;
    }
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        name = "help";
    const CommandRow *row = command_find(parser->table, name);
    if (!row && !is_for_play(name))
        return unknown_command(parser, name);
    if (!row) {
        row = command_find(parser->table, "play");
        parser->at--;
    }
    parser->row = parser->args->row = row;
    parser->args->command = parser->args->help_for = row->command;
    parser->args->width = row->width;
    parser->args->height = row->height;
    return true;
}

static bool parse_rest(Parser *parser)
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
    if (parser->args->command == COMMAND_HELP)
        return true;
    if (parser->args->scene_count < parser->row->scenes_min)
        return fail(parser, "the %s is missing; write slosh %s %s", takes(parser->row), parser->row->name,
                    parser->row->usage);
    if (parser->row->output && !parser->args->output)
        return fail(parser, "-o is missing; add -o with %s", parser->row->output);
    const bool listens = parser->args->command == COMMAND_PLAY || parser->args->command == COMMAND_DEVICES;
    if (parser->args->mapping && !parser->args->device && !listens)
        return fail(parser, "--mapping says what motion devices do; add --device file:PATH, or leave it out");
    return true;
}

bool args_parse(const ArgsTable *table, int argc, char *const argv[], Args *args, Error *error)
{
    memset(args, 0, sizeof *args);
    args->time = 5;
    args->every = 1.0 / 30;
    args->fps = 30;
    args->seconds = 20;
    args->past = 256; /* over a minute of 8,000 particles (docs/window.md) */
    args->gpu = -1;
    Parser parser = {.table = table, .argc = argc, .at = 1, .argv = argv, .args = args, .error = error};
    if (!parse_command(&parser))
        return false;
    if (args->command == COMMAND_HELP)
        return parse_help(&parser);
    if (!parser.row) /* --version */
        return true;
    return parse_rest(&parser);
}
