#define _GNU_SOURCE /* FNM_EXTMATCH */
#include "app/base/file.h"
#include "app/cli/cli_private.h"
#include "app/input/input.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "sim/base/base.h"

#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct CommandFile {
    FileUse use;
    const char *word;    /* "--json", "the scene" */
    const char *pattern; /* a folder: pattern of its relevant files; NULL: a file */
    char name[1024];     /* as typed by the user */
    char place[PATH_MAX];
} CommandFile;

struct CommandFiles {
    size_t count, capacity;
    CommandFile *file;
    bool lacks; /* memory was short */
};

void command_files_add(CommandFiles *files, FileUse use, const char *word, const char *name,
                       const char *pattern)
{
    if (!name)
        return;
    if (files->count == files->capacity &&
        !array_grow((void **)&files->file, &files->capacity, 2 * files->capacity + 16, sizeof *files->file)) {
        files->lacks = true;
        return;
    }
    CommandFile *file = &files->file[files->count];
    if (!path_resolve(name, file->place))
        return;
    file->use = use;
    file->word = word;
    file->pattern = pattern;
    snprintf(file->name, sizeof file->name, "%s", name);
    files->count++;
}

/* ---- written files ---- */

void command_files_add_beside(CommandFiles *files, const char *word, const char *path, size_t length,
                              const char *ending, const char *pattern)
{
    char name[1024];
    if (strlen(path) < length ||
        snprintf(name, sizeof name, "%.*s%s", (int)(strlen(path) - length), path, ending) >= (int)sizeof name)
        return;
    command_files_add(files, FILE_REPLACED, word, name, pattern);
}

void files_replaced(CommandFiles *files, const OptionRow *row, const char *value)
{
    command_files_add(files, FILE_REPLACED, row->name, value, row->pattern);
}

void files_new(CommandFiles *files, const OptionRow *row, const char *value)
{
    command_files_add(files, FILE_NEW, row->name, value, NULL);
}

void files_json(CommandFiles *files, const OptionRow *row, const char *value)
{
    if (!json_is_stream(value))
        files_replaced(files, row, value);
}

void files_chart(CommandFiles *files, const OptionRow *row, const char *value)
{
    const char *dot = strrchr(value, '.');
    files_replaced(files, row, value);
    if (dot)
        command_files_add_beside(files, "the figures of -o", value, strlen(dot), ".csv", NULL);
}

/* ---- read files ---- */

void files_read(CommandFiles *files, const OptionRow *row, const char *value)
{
    command_files_add(files, FILE_READ, row->name, value, row->pattern);
}

void files_device(CommandFiles *files, const OptionRow *row, const char *value)
{
    command_files_add(files, FILE_READ, row->name, value + strlen("file:"), NULL);
}

static void add_table(void *user, const char *what, const char *path)
{
    const bool table = strcmp(what, "table") == 0, mesh = strcmp(what, "mesh") == 0;
    command_files_add(user, FILE_READ,
                      table  ? "the scene's table"
                      : mesh ? "the scene's mesh"
                             : "the scene's volume",
                      path, NULL);
}

static void add_tables(CommandFiles *files, const Args *args, const char *path)
{
    size_t size;
    Error none;
    char *bytes = scene_file_read(path, &size, &none);
    if (bytes)
        scene_find_tables(path, bytes, size, &args->settings, add_table, files);
    free(bytes);
}

void files_recording(CommandFiles *files, const Args *args, const char *name)
{
    (void)args;
    Recording recording;
    Error none;
    command_files_add(files, FILE_READ, "the recording", name, NULL);
    if (!recording_read(name, &recording, &none))
        return;
    scene_find_tables(recording.path, recording.text, recording.size, &recording.settings, add_table, files);
    recording_destroy(&recording);
}

void files_scene(CommandFiles *files, const Args *args, const char *name)
{
    char path[SCENE_PATH_SIZE];
    if (!scene_path_find(name, path, NULL))
        return;
    command_files_add(files, FILE_READ, "the scene", path, NULL);
    add_tables(files, args, path);
}

void files_snapshots(CommandFiles *files, const Args *args, const char *name)
{
    (void)args;
    command_files_add(files, FILE_READ, "the file of snapshots", name, NULL);
}

/* Adds the files of the options. */
static void add_options(CommandFiles *files, const Args *args)
{
    for (const OptionRow *row = args->command->options; row->name; row++)
        if (row->files && args_given(args, row->name))
            row->files(files, row, args_text(args, row));
    if (args->command->unnamed_files)
        args->command->unnamed_files(files, args);
}

/* Adds what is read besides: the arguments, and files that nobody names. */
static void add_inputs(CommandFiles *files, const Args *args)
{
    char path[SCENE_PATH_SIZE];
    for (int i = 0; args->command->argument_files && i < args->scene_count; i++)
        args->command->argument_files(files, args, args->scenes[i]);
    if (scene_path_find("scenes", path, NULL))
        command_files_add(files, FILE_READ, "the folder of scenes", path, "*.yaml");
    if (scene_path_find("scenes/reference", path, NULL))
        command_files_add(files, FILE_READ, "the folder of references", path, "*.csv");
    if (!args->mapping && mapping_user_path(path))
        command_files_add(files, FILE_READ, "your own mapping", path, NULL);
}

/* ---- comparison ---- */

/* True if both paths lead to one file. */
static bool is_same(const CommandFile *a, const CommandFile *b)
{
    struct stat one, other;
    if (stat(a->place, &one) == 0 && stat(b->place, &other) == 0)
        return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
    return strcmp(a->place, b->place) == 0;
}

static bool holds(const CommandFile *folder, const CommandFile *file)
{
    const size_t length = strlen(folder->place);
    return folder->pattern && strncmp(folder->place, file->place, length) == 0 &&
           file->place[length] == '/' &&
           fnmatch(folder->pattern, file->place + length + 1, FNM_EXTMATCH) == 0;
}

static bool meet(const CommandFile *output, const CommandFile *other, const char *command, Error *error)
{
    const bool read = other->use == FILE_READ, folder = read && other->pattern;
    if ((output->use == FILE_NEW && read) ||
        !((!folder && is_same(output, other)) || holds(output, other) || holds(other, output)))
        return false;
    if (read)
        error_set(error, "slosh %s: %s %.300s would replace %s %.300s; name another file", command,
                  output->word, output->name, other->word, other->name);
    else
        error_set(error, "slosh %s: %s %.300s and %s %.300s would replace each other; name another file",
                  command, output->word, output->name, other->word, other->name);
    return true;
}

/* True if none of the first `options` files, those of the options, meets another one. */
static bool stay_apart(const CommandFiles *files, size_t options, const char *command, Error *error)
{
    for (size_t i = 0; i < options; i++)
        for (size_t k = 0; k < files->count; k++)
            if (files->file[i].use != FILE_READ && (k > i || files->file[k].use == FILE_READ) &&
                meet(&files->file[i], &files->file[k], command, error))
                return false;
    return true;
}

bool command_files_check(const Args *args, Error *error)
{
    CommandFiles files = {0};
    if (!args->command || args->help)
        return true;
    add_options(&files, args);
    const size_t options = files.count;
    bool writes = false;
    for (size_t i = 0; i < options; i++)
        writes |= files.file[i].use != FILE_READ;
    if (writes)
        add_inputs(&files, args);
    const bool apart = stay_apart(&files, options, args->command->name, error);
    free(files.file);
    return apart && (!files.lacks || error_set(error, "slosh %s: out of memory", args->command->name));
}
