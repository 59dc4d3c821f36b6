/* Formats in one file: particles as a text of chemistry, "xyz": a count, a line of words, then a line a
   particle; and a video as ffmpeg writes it without loss. They add themselves to the lists. */
#ifndef SLOSH_TESTS_TOY_FORMAT_H
#define SLOSH_TESTS_TOY_FORMAT_H

#include "app/files/export.h"
#include "app/files/pictures.h"

static bool toy_format_write(FILE *file, const ExportContent *content)
{
    const SnapshotStep *step = content->particles;
    const size_t count = step ? step->count : content->mesh[0].mesh->vertices.count;
    fprintf(file, "%zu\n%g s, frame of the %s\n", count, content->time, content->frame);
    for (size_t i = 0; step && i < count; i++)
        fprintf(file, "O %.9g %.9g %.9g\n", (double)step->position[0][i], (double)step->position[1][i],
                (double)step->position[2][i]);
    return !ferror(file);
}

static const ExportFormat format_toy = {
    .extension = "xyz",
    .help = "one snapshot as atoms",
    .holds = EXPORT_PARTICLES | EXPORT_MESH,
    .write = toy_format_write,
};

static const ExportFormat format_toy_series = {
    .extension = "xyz.series",
    .help = "all snapshots: an index, and a folder with a .xyz for each",
    .holds = EXPORT_PARTICLES | EXPORT_MESH,
    .each = &format_toy,
    .index = export_index_series,
};

static const char *const toy_encoder[] = {"-c:v", "ffv1", "-f", "matroska", NULL};

static const PictureFormat format_toy_video = {
    .extension = "mkv",
    .help = "a video without loss",
    .kind = PICTURES_VIDEO,
    .encoder = toy_encoder,
};

static inline void toy_format_add(void)
{
    picture_format_add(&format_toy_video);
    export_format_add(&format_toy);
    export_format_add(&format_toy_series);
}

#endif
