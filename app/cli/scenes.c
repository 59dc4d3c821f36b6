#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/window/play.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static int fail(int code, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

static void print_list(const SceneList *list)
{
    for (int i = 0; i < list->count; i++) {
        const SceneRow *row = &list->rows[i];
        char name[sizeof row->name];
        memcpy(name, row->name, sizeof name);
        text_tame(name);
        printf("%-13s %s\n", name, row->title);
        if (*row->idea)
            printf("%-13s %s\n", "", row->idea);
    }
}

static bool write_json(const SceneList *list, const char *path, Error *error)
{
    json_t *rows = json_array();
    for (int i = 0; i < list->count; i++) {
        const SceneRow *row = &list->rows[i];
        json_array_append_new(rows, json_pack("{s:s, s:s, s:s, s:s}", "name", row->name, "path", row->path,
                                              "title", row->title, "idea", row->idea));
    }
    const bool written = json_file_write(rows, path, error);
    json_decref(rows);
    return written;
}

/* Writes text with HTML's special characters escaped. */
static void put_text(FILE *file, const char *text)
{
    for (; *text; text++) {
        const char *word = *text == '&' ? "&amp;" : *text == '<' ? "&lt;" : *text == '"' ? "&quot;" : NULL;
        if (word)
            fputs(word, file);
        else
            fputc(*text, file);
    }
}

/* A name as a part of an address: all but letters, digits and - . _ ~ as numbers of bytes. */
static void put_url(FILE *file, const char *name)
{
    for (; *name; name++)
        if (isalnum((unsigned char)*name) || strchr("-._~", *name))
            fputc(*name, file);
        else
            fprintf(file, "%%%02X", (unsigned char)*name);
}

static void put_row(FILE *file, const SceneRow *row, bool picture)
{
    fputs("<figure>", file);
    if (picture) {
        fputs("<img alt=\"\" src=\"", file);
        put_url(file, row->name);
        fputs(".png\">", file);
    }
    fputs("<figcaption><b>", file);
    put_text(file, row->title);
    fputs("</b><br>", file);
    put_text(file, row->idea);
    fputs("<br><code>slosh ", file);
    put_text(file, row->name);
    fputs("</code></figcaption></figure>\n", file);
}

static bool write_index(const SceneList *list, const char *folder, Error *error)
{
    Output output = {.temp = ""};
    char path[1024], thumbnail[1024];
    struct stat there;
    if (snprintf(path, sizeof path, "%s/index.html", folder) >= (int)sizeof path)
        return error_set(error, "%.300s: the path is too long", folder);
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        fputs("<!DOCTYPE html><meta charset=\"utf-8\"><title>Scenes of slosh</title>\n"
              "<style>body{display:flex;flex-wrap:wrap;font:14px sans-serif;background:#161b21;color:#e4e9ee}"
              "figure{width:256px;margin:8px}img{width:256px;height:144px}</style>\n",
              file);
        for (int i = 0; i < list->count; i++)
            put_row(file, &list->rows[i],
                    thumbnail_path(folder, list->rows[i].name, thumbnail) && stat(thumbnail, &there) == 0);
    }
    const bool written = file && !ferror(file);
    if ((file && fclose(file) != 0) || !written)
        error_set(error, "%.300s: %s", path, strerror(errno));
    else if (output_commit(&output, error))
        return true;
    output_discard(&output);
    return false;
}

/* The state of a call with -o. */
typedef struct ThumbnailFolder {
    const SceneList *list;
    const char *folder;
    Headless *context;
    int made, kept, failed;
} ThumbnailFolder;

static bool save(const Image *image, const char *path, Error *error)
{
    Output output = {.temp = ""};
    const bool ok = output_begin(&output, path, error) && image_write(image, NULL, output.temp, error) &&
                    output_commit(&output, error);
    output_discard(&output);
    return ok;
}

/* Makes a picture. A broken scene gets no picture; a failed write ends the command. */
static bool make(ThumbnailFolder *folder, const SceneRow *row, Error *error)
{
    char path[1024];
    Image image = {0};
    Error why = {{0}};
    if (!thumbnail_path(folder->folder, row->name, path))
        return error_set(error, "%.300s: the path is too long", folder->folder);
    if (thumbnail_is_new(path, row->path)) {
        folder->kept++;
        return true;
    }
    if (!thumbnail_make(row->path, folder->context, &image, &why)) {
        fprintf(stderr, "%s: no picture: %s\n", row->name, why.message);
        folder->failed++;
        return true;
    }
    const bool saved = save(&image, path, error);
    image_destroy(&image);
    folder->made += saved;
    return saved;
}

static bool make_all(ThumbnailFolder *folder, bool quiet, Error *error)
{
    Progress progress;
    bool ok = true;
    progress_begin(&progress, stderr, "scenes", quiet);
    for (int i = 0; ok && i < folder->list->count && !interrupted(); i++) {
        ok = make(folder, &folder->list->rows[i], error);
        progress_update(&progress, (i + 1.0) / folder->list->count);
    }
    progress_end(&progress);
    return ok;
}

static int write_folder_page(const Args *args, const SceneList *list, Error *error)
{
    ThumbnailFolder folder = {.list = list, .folder = args->output};
    interrupt_install();
    if (mkdir(args->output, 0777) != 0 && errno != EEXIST) {
        error_set(error, "%.300s: the folder cannot be made (%s)", args->output, strerror(errno));
        return fail(EXIT_FAILED, error);
    }
    folder.context = headless_create(args->gpu, error);
    if (!folder.context)
        return fail(EXIT_FAILED, error);
    renderer_tell(headless_renderer(folder.context));
    const bool ok = make_all(&folder, args->quiet, error) && write_index(list, args->output, error);
    headless_destroy(folder.context);
    if (!ok)
        return fail(EXIT_FAILED, error);
    if (!args->quiet)
        fprintf(stderr, "%s/index.html: %d scene%s, %d picture%s made, %d kept\n", args->output, list->count,
                list->count == 1 ? "" : "s", folder.made, folder.made == 1 ? "" : "s", folder.kept);
    return interrupted() ? EXIT_INTERRUPTED : folder.failed ? EXIT_FAILED : 0;
}

static int run_command(const Args *args)
{
    Error error = {{0}};
    SceneList list;
    if (!scene_list_read(args->scene_count ? args->scenes[0] : NULL, &list, &error))
        return fail(EXIT_USAGE, &error);
    int code = 0;
    if (args->json && !write_json(&list, args->json, &error))
        code = fail(EXIT_FAILED, &error);
    else if (args->output)
        code = write_folder_page(args, &list, &error);
    else if (!args->quiet && !(args->json && json_is_stream(args->json)))
        print_list(&list);
    scene_list_free(&list);
    return code;
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("FOLDER", .files = files_replaced, .pattern = "*.@(png|html)", .help = "a folder for a small picture of each scene, and for index.html, which shows them all; a picture that is newer than its scene is kept"),
    ROW_GPU, ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_scenes = {
    .name = "scenes",
    .usage = "[FOLDER] [-o FOLDER] [OPTIONS]",
    .help = "lists the scenes that come with slosh, or those of a folder; with -o also as pictures",
    .takes = "folder",
    .takes_max = 1,
    .options = options,
    .run = run_command,
};
