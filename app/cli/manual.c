#include "app/cli/cli_private.h"
#include "app/scene/scene.h"

#include <string.h>

void option_words(const Command *command, const OptionRow *option, char *text, size_t size)
{
    const Key *key = option->path ? scene_key_find(option->path) : NULL;
    const Key named = {.choice = option->names}, *names = key ? key : &named;
    size_t at = (size_t)snprintf(text, size, "%s", option->help);
    for (int i = 0; key_choice(names, i) && at < size; i++)
        at += (size_t)snprintf(text + at, size - at, "%s%s", i ? ", " : ": ", key_choice(names, i));
    if (option->kind == OPTION_SIZE && command->width > 0 && at < size)
        snprintf(text + at, size - at, " (%dx%d)", command->width, command->height);
}

/* Fills in the option's value at `index`, from its list or from "a|b|c"; returns false past the last. */
static bool value_at(const OptionRow *option, int index, char value[64])
{
    const Key *key = option->path ? scene_key_find(option->path) : NULL;
    const Key named = {.choice = option->names};
    const char *name = key_choice(key ? key : &named, index);
    if (option->kind == OPTION_CHOICE) {
        name = option->value;
        for (int i = 0; name && i < index; i++)
            name = strchr(name, '|') ? strchr(name, '|') + 1 : NULL;
    }
    if (!name)
        return false;
    snprintf(value, 64, "%.*s", (int)strcspn(name, "|"), name);
    return true;
}

static bool takes_setting(const OptionRow *option)
{
    return option->kind == OPTION_SWEEP || option->kind == OPTION_LIST ||
           (option->kind == OPTION_SETTING && !option->path);
}

/* Writes a shell `case` line over the preceding word, with the values of the option. */
static void put_values(FILE *file, const OptionRow *option)
{
    char value[64];
    if (!option->value)
        return;
    fprintf(file, "        %s) offered='' scenes=''", option->name);
    for (int i = 0; value_at(option, i, value); i++)
        fprintf(file, "%s%s", i ? " " : " values='", value);
    fprintf(file, "%s ;;\n",
            takes_setting(option)        ? " values=$keys end=''"
            : value_at(option, 0, value) ? "'"
                                         : "");
}

static void put_words_of_command(FILE *file, const Command *command, const char *pattern)
{
    fprintf(file, "    %s)\n        offered='", pattern);
    for (const OptionRow *option = command->options; option->name; option++)
        if (option->kind != OPTION_REFUSED)
            fprintf(file, "%s ", option->name);
    fputs("'\n        case $before in\n", file);
    for (const OptionRow *option = command->options; option->name; option++)
        if (option->kind != OPTION_REFUSED)
            put_values(file, option);
    fputs("        esac\n        ;;\n", file);
}

/* Writes the paths usable in --set; paths of lists need an index and are skipped. */
static void put_keys(FILE *file)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (!strstr(keys[i].path, "[]") && keys[i].type != KEY_MAPPING && keys[i].type != KEY_LIST)
            fprintf(file, "%s= ", keys[i].path);
}

static void put_lists(FILE *file)
{
    SceneNames scenes;
    scene_path_names(&scenes);
    fputs("    local verbs='", file);
    for (CommandList at = cli_commands; *at; at++)
        fprintf(file, "%s ", (*at)->name);
    fputs("' topics='", file);
    for (const HelpTopic *topic = help_topics; topic->name; topic++)
        fprintf(file, "%s ", topic->name);
    fputs("'\n    local scenes='", file);
    for (int i = 0; i < scenes.count; i++)
        fprintf(file, "%s ", scenes.name[i]);
    fputs("'\n    local keys='", file);
    put_keys(file);
    fputs("'\n", file);
}

/* Writes lists and choice, equal for both shells. zsh reserves the names `commands`, `options` and
   `words`, so different names are used. */
static void put_choice(FILE *file, const char *verb)
{
    put_lists(file);
    fprintf(file, "    case %s in\n", verb);
    for (CommandList at = cli_commands + 1; *at; at++)
        put_words_of_command(file, *at, (*at)->name);
    put_words_of_command(file, cli_commands[0], "*");
    fputs("    esac\n", file);
}

void completion_print_bash(FILE *file)
{
    fputs("# Completion for bash: made by `slosh help bash`.\n"
          "_slosh()\n{\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "    local offered='' values='' end=' '\n",
          file);
    put_choice(file, "${COMP_WORDS[1]}");
    /* bash offers files if there are no words: `-o default`. */
    fputs("    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
          "        values=\"$verbs --version --help\"\n"
          "    elif [ \"${COMP_WORDS[1]}\" = help ]; then\n"
          "        values=\"$verbs $topics\" offered='' scenes=''\n"
          "    fi\n"
          "    [ \"$before\" = = ] && offered='' values='' scenes=''\n"
          "    [ \"$end\" ] || compopt -o nospace 2>/dev/null\n"
          "    case $word in\n"
          "    -*) COMPREPLY=($(compgen -W \"$offered $values\" -- \"$word\")) ;;\n"
          "    *) COMPREPLY=($(compgen -W \"$values $scenes\" -- \"$word\")) ;;\n"
          "    esac\n"
          "}\n"
          "complete -o default -F _slosh slosh\n",
          file);
}

void completion_print_zsh(FILE *file)
{
    fputs("#compdef slosh\n"
          "# Completion for zsh: made by `slosh help zsh`.\n"
          "_slosh()\n{\n"
          "    local before=${words[CURRENT - 1]} offered='' values='' end=' '\n",
          file);
    put_choice(file, "${words[2]}");
    fputs("    if (( CURRENT == 2 )); then\n"
          "        values=\"$verbs --version --help\"\n"
          "    elif [[ ${words[2]} == help ]]; then\n"
          "        values=\"$verbs $topics\" offered='' scenes=''\n"
          "    fi\n"
          "    local -a found=(${=values})\n"
          "    if [[ $PREFIX == -* ]]; then\n"
          "        found+=(${=offered})\n"
          "    else\n"
          "        found+=(${=scenes})\n"
          "    fi\n"
          "    compadd -S \"$end\" -- $found || _files\n"
          "}\n"
          "_slosh \"$@\"\n",
          file);
}

/* Writes text for roff, without requests; hyphens are written as typed. */
static void put_text(FILE *file, const char *text)
{
    if (*text == '.' || *text == '\'')
        fputs("\\&", file);
    for (; *text; text++)
        if (*text == '\\')
            fputs("\\e", file);
        else if (*text == '-')
            fputs("\\-", file);
        else
            fputc(*text, file);
}

static void put_line(FILE *file, const char *text)
{
    put_text(file, text);
    fputc('\n', file);
}

/* "slosh render SCENE -o OUT" with the name of the command in bold. */
static void put_usage(FILE *file, const Command *command)
{
    fprintf(file, "\\fBslosh %s\\fR ", command->name);
    put_line(file, command->usage);
}

static void put_option(FILE *file, const Command *command, const OptionRow *option)
{
    char words[OPTION_WORDS_SIZE];
    fputs(".TP\n\\fB", file);
    put_text(file, option->name);
    fputs("\\fR", file);
    if (option->value) {
        fputs(" \\fI", file);
        put_text(file, option->value);
        fputs("\\fR", file);
    }
    fputc('\n', file);
    option_words(command, option, words, sizeof words);
    put_line(file, words);
}

static void put_command(FILE *file, const Command *command)
{
    fputs(".SS ", file);
    put_usage(file, command);
    put_line(file, command->help);
    for (const OptionRow *option = command->options; option->name; option++)
        if (option->kind != OPTION_REFUSED)
            put_option(file, command, option);
}

static const char head[] =
    ".SH DESCRIPTION\n"
    "slosh simulates a fluid with smoothed particle hydrodynamics, shows it live, and measures both: what each "
    "stage costs, and how right the result is. A scene is a YAML file; it may be named without its folder "
    "and ending where it comes with slosh, or lies in one of the folders below.\n"
    "\\fBslosh\\fR without a command is \\fBslosh play\\fR.\n"
    ".SH COMMANDS\n";

static const char tail[] =
    ".SH EXIT STATUS\n"
    "0: done. 1: it failed, or a check did not hold. 2: the command line or the scene is wrong; nothing was "
    "written. 130: stopped by a signal, with the file in hand finished.\n"
    ".SH FILES\n"
    ".TP\n\\fIPREFIX/share/slosh/scenes\\fR\nScenes that come with slosh.\n"
    ".TP\n\\fI$XDG_CONFIG_HOME/slosh\\fR, \\fI~/.config/slosh\\fR\n"
    "Scenes of one's own, there or in its folder scenes; mapping.yaml: what motion devices do.\n"
    ".SH EXAMPLES\n"
    ".nf\n"
    "slosh dam_break\n"
    "slosh render dam_break \\-o dam.mp4 \\-\\-time 2 \\-\\-view splat\n"
    "slosh run two_oils \\-o oils.h5part \\-\\-set gravity=[0,\\-5,0]\n"
    ".fi\n";

void manual_print(FILE *file)
{
    fputs(".TH SLOSH 1 \"\" \"slosh " SLOSH_VERSION "\" \"User Commands\"\n"
          ".SH NAME\nslosh \\- a fluid of particles, simulated, shown and measured\n.SH SYNOPSIS\n",
          file);
    for (CommandList at = cli_commands; *at; at++) {
        put_usage(file, *at);
        fputs(".br\n", file);
    }
    fputs("\\fBslosh \\-\\-version\\fR\n", file);
    fputs(head, file);
    for (CommandList at = cli_commands; *at; at++)
        put_command(file, *at);
    for (const HelpTopic *topic = help_topics; topic->name; topic++)
        if (topic->help)
            fprintf(file, ".TP\n\\fBslosh help %s\\fR\nPrints %s.\n", topic->name, topic->help);
    fputs(tail, file);
}
