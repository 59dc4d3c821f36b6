/* Pictures as files: PNG with the scene embedded, MP4, GIF, a folder of PNG files. */
#ifndef APP_FILES_PICTURES_H
#define APP_FILES_PICTURES_H

#include "app/scene/scene.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* PNG files of 8-bit RGB, rows from the top down. */

/* 3 * width * height bytes, sRGB. */
typedef struct Image {
    int width, height;
    uint8_t *rgb; /* owned */
} Image;

/* The scene embedded in a picture's file as text: PICTURE_SCENE and further keywords
   (app/scene/scene.h). */
typedef struct ImageText {
    const char *scene; /* YAML of the scene */
    const char *name;  /* name of the scene file, without folders */
    double time;       /* time of the picture, s */
} ImageText;

/* Returns false if memory is short. */
bool image_create(Image *image, int width, int height);
void image_destroy(Image *image);

/* Writes into an open stream and flushes the stream, which stays open. Returns false with the reason on any
   failure, such as a full disk. `name` is for messages. `text`: NULL for none. */
bool image_write_stream(const Image *image, const ImageText *text, FILE *stream, const char *name,
                        Error *error);

/* Writes the file `path`; leaves no file on failure. Use a temporary name and rename for files that must
   appear complete. */
bool image_write(const Image *image, const ImageText *text, const char *path, Error *error);

/* Reads a PNG file with any kind of pixels; returns false with the reason, and nothing to destroy. */
bool image_read(const char *path, Image *image, Error *error);

/* MP4 files of H.264 and animated GIFs, written through a pipe to ffmpeg. */

typedef struct Video Video;

/* Starts ffmpeg, for the video format of the path's name; see PictureFormat. The file appears under its name
   when complete. Returns NULL with the reason: not a name of a video, not writable (see output_begin), too
   many pictures a second, or ffmpeg is missing. */
Video *video_create(const char *path, int width, int height, double fps, Error *error);

/* Adds a picture: 3 * width * height bytes of sRGB, rows from the top down. Returns false if ffmpeg has
   ended: `error` has its last line. */
bool video_add(Video *video, const uint8_t *rgb, Error *error);

/* Waits for ffmpeg, gives the file its name and frees `video`. Leaves no file on failure. A video without
   pictures is a failure. */
bool video_finish(Video *video, Error *error);

/* Ends ffmpeg, removes the file, frees `video`; NULL is allowed. */
void video_discard(Video *video);

/* Output of `render`, chosen by the name: one PNG, a video, or a folder of PNG files. */

typedef enum PicturesKind { PICTURES_PNG, PICTURES_VIDEO, PICTURES_FOLDER } PicturesKind;

/* A format of pictures owns all that names it: one const struct, and a line in the list of app/files/video.c.
   `render`, its messages and `slosh info` follow. */
typedef struct PictureFormat {
    const char *extension; /* without the dot: "png"; "": a folder of PNG files */
    const char *help;
    PicturesKind kind;
    const char *const *encoder; /* of a video: ffmpeg's options after the input, ended by NULL */
    double fps_max;             /* of a video; 0: any */
    bool even; /* of a video: width and height must be even, and colours are those of BT.709. An odd width or
                  height gets its last column or row twice */
} PictureFormat;

/* The formats, in the order of messages; NULL after the last. */
const PictureFormat *picture_format_at(int index);

/* Adds a format at the end of the list: for programs with formats of their own. At most 4; each must live as
   long as the program. */
void picture_format_add(const PictureFormat *format);

/* The kind of the format of a name: by its extension, or a folder (no extension, or a final slash). False for
   other extensions. */
bool pictures_kind(const char *path, PicturesKind *kind, Error *error);

typedef struct Pictures Pictures;

/* A folder that is missing is created (not those above it). NULL with the reason, see output_begin and
   video_create. `count` pictures are to come, with numbers in a folder as wide as the last number; 0: not
   known. */
Pictures *pictures_create(const char *path, int width, int height, double fps, size_t count, Error *error);

/* Embeds the scene of `text` in all later PNG files; `text` must outlive `pictures`; NULL: none. */
void pictures_embed(Pictures *pictures, const ImageText *text);

/* One more picture, of that size. In a folder each is a whole file of its own, frame_00000.png and so on, or
   with more digits where there are more. A second one into a PNG is a mistake of the caller. */
bool pictures_add(Pictures *pictures, const Image *image, Error *error);

/* Finds the folder's next frame, if left by an earlier, longer run; `frame` gets its path. Returns false if
   there is none. */
bool pictures_find_stale(const Pictures *pictures, char frame[1088]);

/* Finishes the file and frees `pictures`; on failure returns false and leaves no partial file. */
bool pictures_finish(Pictures *pictures, Error *error);

/* Removes partial files and frees; NULL is allowed. Frames in a folder are complete and stay. */
void pictures_discard(Pictures *pictures);

/* Count of frames left in a folder after a discard; NULL is allowed. */
size_t pictures_kept(const Pictures *pictures);

/* The scene embedded in a picture: the present scene, without traces of the user's machine. */

/* Owned by the caller of embedded_scene_make; ImageText points into this struct. */
typedef struct EmbeddedScene {
    char *scene; /* NULL: none */
    char name[128];
} EmbeddedScene;

/* Makes the scene's text with its settings, and its name without folders. Whole paths of files are shortened
   to names: such a scene finds the files beside the picture. Returns false with the reason, and nothing to
   free: then the picture should carry no scene. */
bool embedded_scene_make(const SceneSource *save, EmbeddedScene *out, Error *error);

ImageText embedded_scene_text(const EmbeddedScene *embedded, double time);
void embedded_scene_free(EmbeddedScene *embedded);

/* Names for files that the window writes into the present folder. */

/* New name such as slosh-20261121-101500.png, or with -2, -3, ... if the name is taken. */
void dated_file_name(char path[1024], const char *extension);

#endif
