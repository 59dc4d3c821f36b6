/* Writes screenshots and videos of the window, with new names in the present folder. */
#ifndef SLOSH_PLAY_FILES_H
#define SLOSH_PLAY_FILES_H

#include "app/files/pictures.h"
#include "app/play/notice.h"
#include "render/panels.h"

/* Zero-initialise before use. */
typedef struct Files {
    bool shoot;   /* save the next picture */
    Video *video; /* NULL: no video */
    char path[1024];
    int width, height;
    double next_ms; /* wall time at which the video's next picture is due */
    size_t pictures;
} Files;

/* True if the video needs a picture now. */
bool files_due(const Files *files);

/* Saves the last drawn picture as screenshot and video frame, as needed. A screenshot embeds `text` (may be
   NULL). */
void files_take(Files *files, const Panels *panels, int width, int height, const ImageText *text,
                Notice *notice);

/* Starts a video of that size, or ends the present video. */
void files_video(Files *files, int width, int height, Notice *notice);

/* Ends a video; returns false if the video could not be written completely. */
bool files_end(Files *files, Notice *notice);

#endif
