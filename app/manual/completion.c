#include "app/manual/manual.h"

#include "app/scene/keys.h"
#include "app/scene/scene_files.h"
#include "app/session/args_table.h"

#include <string.h>

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
    return option->kind == OPTION_SWEEP || option->kind == OPTION_AXIS ||
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

static void put_command(FILE *file, const CommandRow *row, const char *pattern)
{
    fprintf(file, "    %s)\n        offered='", pattern);
    for (const OptionRow *option = option_rows; option->name; option++)
        if (option_listed(option, row->command))
            fprintf(file, "%s ", option->name);
    fputs("'\n        case $before in\n", file);
    for (const OptionRow *option = option_rows; option->name; option++)
        if (option_listed(option, row->command))
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
    for (const CommandRow *row = command_rows; row->name; row++)
        fprintf(file, "%s ", row->name);
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
    for (const CommandRow *row = command_rows; row->name; row++)
        if (row->command != COMMAND_PLAY)
            put_command(file, row, row->name);
    put_command(file, command_row(COMMAND_PLAY), "*");
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
