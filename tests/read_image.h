/* Any PNG as RGB in a new image. */
#ifndef SLOSH_TEST_READ_IMAGE_H
#define SLOSH_TEST_READ_IMAGE_H

#include "app/output/image.h"

#include <png.h>

static inline bool image_read(Image *image, const char *path, Error *error)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    *image = (Image){0};
    if (!png_image_begin_read_from_file(&png, path))
        return error_set(error, "%s: cannot read the picture: %s", path, png.message);
    png.format = PNG_FORMAT_RGB;
    if (!image_create(image, (int)png.width, (int)png.height)) {
        png_image_free(&png);
        return error_set(error, "%s: out of memory for %u x %u pixels", path, png.width, png.height);
    }
    if (png_image_finish_read(&png, NULL, image->rgb, 0, NULL))
        return true;
    image_destroy(image);
    return error_set(error, "%s: cannot read the picture: %s", path, png.message);
}

#endif
