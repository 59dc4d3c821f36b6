/* Output of `render`, chosen by the name: one PNG, a video, or a folder of PNG files. */
#ifndef SLOSH_PICTURES_H
#define SLOSH_PICTURES_H

#include "app/output/image.h"
#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum PicturesKind { PICTURES_PNG, PICTURES_VIDEO, PICTURES_FOLDER } PicturesKind;

/* Kinds: NAME.png; NAME.mp4 or NAME.gif; or a folder: no extension, or a final slash. Returns false for other
   extensions. */
bool pictures_kind(const char *path, PicturesKind *kind, Error *error);

typedef struct Pictures Pictures;

/* A folder that is missing is created (not those above it). NULL with the reason, see output_begin and
   video_create. `count` pictures are to come, with numbers in a folder as wide as the last number; 0: not
   known. */
Pictures *pictures_create(const char *path, int width, int height, double fps, size_t count, Error *error);

/* Embeds the scene of `text` in all later PNG files; `text` must outlive `pictures`; NULL: none. */
void pictures_carry(Pictures *pictures, const ImageText *text);

/* One more picture, of that size. In a folder each is a whole file of its own, frame_00000.png and so on, or
   with more digits where there are more; a second one into a PNG is a mistake of the caller. */
bool pictures_add(Pictures *pictures, const Image *image, Error *error);

/* Finds the folder's next frame, if left by an earlier, longer run; `frame` gets its path. Returns false if
   there is none. */
bool pictures_has_older(const Pictures *pictures, char frame[1088]);

/* Finishes the file and frees `pictures`; on failure returns false and leaves no partial file. */
bool pictures_finish(Pictures *pictures, Error *error);

/* Removes partial files and frees; NULL is allowed. Frames in a folder are complete and stay. */
void pictures_discard(Pictures *pictures);

/* Count of frames left in a folder after a discard; NULL is allowed. */
size_t pictures_staying(const Pictures *pictures);

#endif
