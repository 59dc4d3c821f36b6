/* libslosh: pictures of a world, drawn without a window. Needs EGL and OpenGL 4.5; Mesa's software driver
   will do. slosh/scene.h has the rules for all functions. */
#ifndef SLOSH_PICTURE_H
#define SLOSH_PICTURE_H

#include "slosh/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A picture of a world, for many frames: the first drawing compiles shaders. Overlays follow particles
   from drawing to drawing. */
typedef struct slosh_picture slosh_picture;

/* Makes a picture of `width` by `height` pixels, with the scene's view and `count` settings of live keys on
   top: "view.kind=splat". Use a picture on the thread of the creation only. After each call no context of
   OpenGL is current there. Free with slosh_picture_free, before the world. Errors of OpenGL, faults of slosh
   or of a driver, print a line on standard error. */
SLOSH_API slosh_picture *slosh_picture_create(slosh_world *world, const char *const settings[], size_t count,
                                              int width, int height, slosh_error *error);
SLOSH_API void slosh_picture_free(slosh_picture *picture); /* NULL is allowed */

/* Draws the present state of the world into `rgb`: 3 width height bytes of sRGB, rows from the top. `size`:
   of `rgb` in bytes. */
SLOSH_API bool slosh_picture_draw(slosh_picture *picture, uint8_t *rgb, size_t size, slosh_error *error);

/* The name of OpenGL's renderer. */
SLOSH_API const char *slosh_picture_renderer(const slosh_picture *picture);

#ifdef __cplusplus
}
#endif

#endif
