#include "app/manual/manual.h"

#include "app/session/args_table.h"

#include <string.h>

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
static void put_usage(FILE *file, const CommandRow *row)
{
    fprintf(file, "\\fBslosh %s\\fR ", row->name);
    put_line(file, row->usage);
}

static void put_option(FILE *file, const CommandRow *row, const OptionRow *option)
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
    option_words(row, option, words, sizeof words);
    put_line(file, words);
}

static void put_command(FILE *file, const CommandRow *row)
{
    fputs(".SS ", file);
    put_usage(file, row);
    put_line(file, row->help);
    for (const OptionRow *option = option_rows; option->name; option++)
        if (option_listed(option, row->command))
            put_option(file, row, option);
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
    for (const CommandRow *row = command_rows; row->name; row++) {
        put_usage(file, row);
        fputs(".br\n", file);
    }
    fputs("\\fBslosh \\-\\-version\\fR\n", file);
    fputs(head, file);
    for (const CommandRow *row = command_rows; row->name; row++)
        put_command(file, row);
    for (const HelpTopic *topic = help_topics; topic->name; topic++)
        if (topic->help)
            fprintf(file, ".TP\n\\fBslosh help %s\\fR\nPrints %s.\n", topic->name, topic->help);
    fputs(tail, file);
}
