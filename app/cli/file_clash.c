#define _GNU_SOURCE /* FNM_EXTMATCH */
#include "app/base/file.h"
#include "app/base/output.h"
#include "app/cli/cli_private.h"
#include "app/files/export.h"
#include "app/files/pictures.h"
#include "app/input/mapping.h"
#include "app/lab/fit.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene_files.h"

#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { FILES_MAX = 2 * ARGS_SCENES_MAX + 256 }; /* a scene each, and for some a table or mesh per fill */

typedef enum Use { FILE_READ, FILE_REPLACED, FILE_NEW /* refused if the file exists */ } Use;

typedef struct CommandFile {
    Use use;
    const char *word;    /* "--json", "the scene" */
    const char *pattern; /* a folder: pattern of its relevant files; NULL: a file */
    char name[1024];     /* as typed by the user */
    char place[PATH_MAX];
} CommandFile;

typedef struct CommandFiles {
    int count;
    CommandFile file[FILES_MAX];
} CommandFiles;

/* Adds a file; ignores unresolvable paths, which the command reports itself. */
static void add(CommandFiles *files, Use use, const char *word, const char *name, const char *pattern)
{
    CommandFile *file = &files->file[files->count];
    if (!name || files->count == FILES_MAX || !path_resolve(name, file->place))
        return;
    file->use = use;
    file->word = word;
    file->pattern = pattern;
    snprintf(file->name, sizeof file->name, "%s", name);
    files->count++;
}

/* ---- written files ---- */

/* Adds `path` with its last `length` bytes replaced by `ending`. */
static void add_beside(CommandFiles *files, const char *word, const char *path, size_t length,
                       const char *ending, const char *pattern)
{
    char name[1024];
    if (strlen(path) < length ||
        snprintf(name, sizeof name, "%.*s%s", (int)(strlen(path) - length), path, ending) >= (int)sizeof name)
        return;
    add(files, FILE_REPLACED, word, name, pattern);
}

static void add_render(CommandFiles *files, const char *output)
{
    PicturesKind kind;
    const bool folder = pictures_kind(output, &kind, NULL) && kind == PICTURES_FOLDER;
    add(files, FILE_REPLACED, "-o", output, folder ? "frame_[0-9]*.png" : NULL);
}

static void add_export(CommandFiles *files, const char *output)
{
    ExportKind kind;
    add(files, FILE_REPLACED, "-o", output, NULL);
    if (export_kind(output, &kind, NULL) && export_is_series(kind))
        add_beside(files, "the folder of -o", output, strlen(export_kinds()[kind].name) + 1, "", "*");
}

static void add_chart(CommandFiles *files, const char *output)
{
    const char *dot = strrchr(output, '.');
    add(files, FILE_REPLACED, "-o", output, NULL);
    if (dot)
        add_beside(files, "the figures of -o", output, strlen(dot), ".csv", NULL);
}

/* Adds the outputs of fit, which has default names without -o. */
static void add_fit(CommandFiles *files, const Args *args)
{
    char output[1024];
    if (args->output) {
        add_chart(files, args->output);
        return;
    }
    fit_default_output(args->scenes[0], output);
    add(files, FILE_REPLACED, "the scene of slosh fit,", output, NULL);
    add_beside(files, "the table of slosh fit,", output, strlen(".yaml"), ".csv", NULL);
}

static void add_probes(CommandFiles *files, const char *output)
{
    const char *dot = strrchr(output, '.');
    add(files, FILE_REPLACED, "--probes", output, NULL);
    if (dot && strcasecmp(dot, ".csv") != 0)
        add_beside(files, "the table of --probes", output, strlen(dot), ".csv", NULL);
}

static void add_outputs(CommandFiles *files, const Args *args)
{
    const char *output = args->output;
    if (output && args->command == COMMAND_RENDER)
        add_render(files, output);
    else if (output && args->command == COMMAND_EXPORT)
        add_export(files, output);
    else if (output && (args->command == COMMAND_CHART || args->command == COMMAND_STABILITY))
        add_chart(files, output);
    else if (args->command == COMMAND_FIT && args->scene_count > 0)
        add_fit(files, args);
    else
        add(files, FILE_REPLACED, "-o", output,
            args->command == COMMAND_VALIDATE ? "*.svg"
            : args->command == COMMAND_SCENES ? "*.@(png|html)"
                                              : NULL);
    if (args->json && !json_is_stream(args->json))
        add(files, FILE_REPLACED, "--json", args->json, NULL);
    add(files, FILE_REPLACED, "--forces", args->forces, NULL);
    if (args->probes)
        add_probes(files, args->probes);
    add(files, args->command == COMMAND_DEVICES ? FILE_NEW : FILE_REPLACED, "--record", args->record, NULL);
}

/* ---- read files ---- */

static void add_table(void *user, const char *what, const char *path)
{
    const bool table = strcmp(what, "table") == 0, mesh = strcmp(what, "mesh") == 0;
    add(user, FILE_READ,
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

static void add_recording(CommandFiles *files, const char *path)
{
    Recording recording;
    Error none;
    add(files, FILE_READ, "the recording", path, NULL);
    if (!recording_read(path, &recording, &none))
        return;
    scene_find_tables(recording.path, recording.text, recording.size, &recording.settings, add_table, files);
    recording_destroy(&recording);
}

static void add_scene(CommandFiles *files, const Args *args, const char *name)
{
    char path[SCENE_PATH_SIZE];
    if (!scene_path_find(name, path, NULL))
        return;
    add(files, FILE_READ, "the scene", path, NULL);
    add_tables(files, args, path);
}

static void add_scenes(CommandFiles *files, const Args *args)
{
    char path[SCENE_PATH_SIZE];
    for (int i = 0; i < args->scene_count; i++) {
        const char *name = args->scenes[i];
        if (args->command == COMMAND_REPLAY || (args->command == COMMAND_RENDER && recording_is_file(name)))
            add_recording(files, name);
        else if (args->command == COMMAND_EXPORT)
            add(files, FILE_READ, "the file of snapshots", name, NULL);
        else if (args->command != COMMAND_VALIDATE && args->command != COMMAND_SCENES &&
                 args->command != COMMAND_NEW)
            add_scene(files, args, name);
    }
    if (scene_path_find("scenes", path, NULL)) /* read without being named */
        add(files, FILE_READ, "the folder of scenes", path, "*.yaml");
    if (scene_path_find("scenes/reference", path, NULL))
        add(files, FILE_READ, "the folder of references", path, "*.csv");
}

static void add_inputs(CommandFiles *files, const Args *args)
{
    char own[1024];
    add_scenes(files, args);
    if (args->device)
        add(files, FILE_READ, "--device", args->device + strlen("file:"), NULL);
    if (args->mapping)
        add(files, FILE_READ, "--mapping", args->mapping, NULL);
    else if (mapping_user_path(own))
        add(files, FILE_READ, "your own mapping", own, NULL);
    add(files, FILE_READ, "--shaders", args->shaders, "*.@(vert|frag|geom|comp|glsl)");
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

bool file_clash_check(const Args *args, Error *error)
{
    static CommandFiles files;
    const char *command = command_row(args->command)->name;
    files.count = 0;
    add_outputs(&files, args);
    const int outputs = files.count;
    if (outputs > 0)
        add_inputs(&files, args);
    for (int i = 0; i < outputs; i++)
        for (int k = i + 1; k < files.count; k++)
            if (meet(&files.file[i], &files.file[k], command, error))
                return false;
    return true;
}
