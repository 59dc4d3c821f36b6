/* A command in one file: it throws a die for a scene, and adds the letters of words. It adds itself to the
 * list.
 */
#ifndef SLOSH_TESTS_TOY_COMMAND_H
#define SLOSH_TESTS_TOY_COMMAND_H

#include "app/cli/cli.h"
#include "app/cli/option_rows.h"

#include <string.h>

typedef struct ToyOptions {
    double sides;
    const char *words[ARGS_LIST_MAX];
} ToyOptions;

static int toy_sum;

static int toy_run(const Args *args)
{
    const ToyOptions *own = args->own;
    toy_sum = (int)own->sides;
    for (int i = 0; own->words[i]; i++)
        toy_sum += (int)strlen(own->words[i]);
    if (!args->quiet)
        printf("%d\n", toy_sum);
    return 0;
}

static const OptionRow toy_options[] = {
    {"--sides", "N", OPTION_NUMBER, OWN(ToyOptions, sides), .initial = 6, .min = 2, .max = 20,
     .help = "of the die (6)"},
    {"--word", "TEXT", OPTION_LIST, OWN(ToyOptions, words), .help = "a word more"},
    ROWS_END,
};

static const Command command_toy = {
    .name = "toy",
    .usage = "[OPTIONS]",
    .help = "adds up",
    .takes = "scene",
    .options = toy_options,
    .own_size = sizeof(ToyOptions),
    .run = toy_run,
};

static inline void toy_command_add(void)
{
    command_add(&command_toy);
}

#endif
