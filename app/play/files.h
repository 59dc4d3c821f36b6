/* What the window writes of its pictures: single ones and videos, each under a name of its own in the present
   folder. */
#ifndef SLOSH_PLAY_FILES_H
#define SLOSH_PLAY_FILES_H

#include "app/output/image.h"
#include "app/output/video.h"
#include "app/play/notice.h"
#include "render/panels.h"

/* Zero-initialise it. */
typedef struct Files {
    bool shoot;   /* the next picture is to be saved */
    Video *video; /* NULL: none */
    char path[1024];
    int width, height;
    double next_ms; /* wall time at which the video's next picture is due */
    size_t pictures;
} Files;

/* Whether the video needs a picture now. */
bool files_due(const Files *files);

/* Takes what was just drawn, for what waits for it. A single picture carries the text; NULL: none. */
void files_take(Files *files, const Panels *panels, int width, int height, const ImageText *text,
                Notice *notice);

/* Begins a video of that size, or ends the present one. */
void files_video(Files *files, int width, int height, Notice *notice);

/* Ends a video; false when it could not be written whole. */
bool files_end(Files *files, Notice *notice);

#endif
