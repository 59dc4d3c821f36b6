/* Where `render` puts its pictures: one PNG, a video, or a folder of PNG files; the name says which. */
#ifndef SLOSH_PICTURES_H
#define SLOSH_PICTURES_H

#include "app/output/image.h"
#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum PicturesKind { PICTURES_PNG, PICTURES_VIDEO, PICTURES_FOLDER } PicturesKind;

/* NAME.png, NAME.mp4 or NAME.gif, or a folder: no extension, or a slash at the end. False for any other
 * extension. */
bool pictures_kind(const char *path, PicturesKind *kind, Error *error);

typedef struct Pictures Pictures;

/* A folder that is missing is created (not those above it). NULL with the reason, see output_begin and
   video_create. */
Pictures *pictures_create(const char *path, int width, int height, double fps, Error *error);

/* PNG files from now on carry the scene that is said there, which must live as long; NULL: none. */
void pictures_carry(Pictures *pictures, const ImageText *text);

/* One more picture, of that size. In a folder each is a whole file of its own, frame_00000.png and so on; a
   second one into a PNG is a mistake of the caller. */
bool pictures_add(Pictures *pictures, const Image *image, Error *error);

/* Into `frame`, the next frame of a folder when there is one already: of an earlier run, that was longer.
   False when there is none. */
bool pictures_has_older(const Pictures *pictures, char frame[1088]);

/* Finishes the file and frees `pictures`; false, and nothing half-written left, on failure. */
bool pictures_finish(Pictures *pictures, Error *error);

/* Removes what is half-written and frees; NULL is allowed. Frames of a folder are whole and stay. */
void pictures_discard(Pictures *pictures);

/* How many frames of a folder stay if it is discarded; NULL is allowed. */
size_t pictures_staying(const Pictures *pictures);

#endif
