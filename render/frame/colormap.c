/* Stops at equal distances, as published: viridis, inferno and plasma by van der Walt and Smith (matplotlib),
   turbo by Mikhailov (2019), coolwarm by Moreland (2009); between them a Catmull-Rom curve. */
#include "render/frame/colormap.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <string.h>

typedef struct Colormap {
    const char *name;
    int count;
    uint32_t stops[17];
} Colormap;

const char *const colormap_list[] = {"viridis", "inferno", "plasma", "coolwarm", "turbo", "gray", NULL};

static const Colormap colormaps[] = {
    {"viridis",
     11,
     {0x440154, 0x482576, 0x414487, 0x355f8d, 0x2a788e, 0x21918c, 0x22a884, 0x43bf71, 0x7ad151, 0xbddf26,
      0xfde725}},
    {"inferno",
     11,
     {0x000004, 0x160b39, 0x420a68, 0x6a176e, 0x932667, 0xbc3754, 0xdd513a, 0xf37819, 0xfca50a, 0xf6d746,
      0xfcffa4}},
    {"plasma",
     11,
     {0x0d0887, 0x41049d, 0x6a00a8, 0x8f0da4, 0xb12a90, 0xcc4778, 0xe16462, 0xf2844b, 0xfca636, 0xfcce25,
      0xf0f921}},
    {"coolwarm",
     17,
     {0x3b4cc0, 0x4d68d7, 0x6282ea, 0x779af7, 0x8db0fe, 0xa3c2ff, 0xb8d0f9, 0xccd9ee, 0xdddddd, 0xecd3c5,
      0xf5c4ad, 0xf7b194, 0xf49a7b, 0xec7f63, 0xde604d, 0xcb3e38, 0xb40426}},
    {"turbo",
     11,
     {0x30123b, 0x4456c7, 0x3d9bfe, 0x18d5cb, 0x46f783, 0xa2fc3c, 0xe1dc37, 0xfea531, 0xef5a11, 0xc42502,
      0x7a0403}},
    {"gray", 2, {0x000000, 0xffffff}},
};

static double stop_channel(const Colormap *map, int stop, int channel)
{
    int held = stop < 0 ? 0 : stop >= map->count ? map->count - 1 : stop;
    double value = map->stops[held] >> (16 - 8 * channel) & 255;
    if (held == stop)
        return value;
    /* the ends go straight on */
    int inner = stop < 0 ? 1 : map->count - 2;
    return 2 * value - (map->stops[inner] >> (16 - 8 * channel) & 255);
}

static uint8_t channel_at(const Colormap *map, double at, int channel)
{
    int stop = (int)at;
    if (stop > map->count - 2)
        stop = map->count - 2;
    double t = at - stop;
    double a = stop_channel(map, stop - 1, channel), b = stop_channel(map, stop, channel);
    double c = stop_channel(map, stop + 1, channel), d = stop_channel(map, stop + 2, channel);
    double value = b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value + 0.5);
}

bool colormap_fill(const char *name, uint8_t rgb[3 * COLORMAP_SIZE])
{
    for (size_t i = 0; i < sizeof colormaps / sizeof colormaps[0]; i++) {
        const Colormap *map = &colormaps[i];
        if (strcmp(map->name, name) != 0)
            continue;
        for (int entry = 0; entry < COLORMAP_SIZE; entry++)
            for (int k = 0; k < 3; k++)
                rgb[3 * entry + k] = channel_at(map, (map->count - 1.0) * entry / (COLORMAP_SIZE - 1), k);
        return true;
    }
    return false;
}

unsigned colormap_texture(const char *name)
{
    uint8_t rgb[3 * COLORMAP_SIZE];
    GLuint texture;
    if (!colormap_fill(name, rgb))
        return 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glObjectLabel(GL_TEXTURE, texture, -1, "colormap");
    glTextureStorage2D(texture, 1, GL_SRGB8_ALPHA8, COLORMAP_SIZE, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture, 0, 0, 0, COLORMAP_SIZE, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void colormap_follow(ColormapKept *kept, const char *name)
{
    if (kept->texture && strcmp(kept->name, name) == 0)
        return;
    colormap_drop(kept);
    kept->texture = colormap_texture(name);
    snprintf(kept->name, sizeof kept->name, "%s", name);
}

void colormap_drop(ColormapKept *kept)
{
    glDeleteTextures(1, &kept->texture);
    *kept = (ColormapKept){0};
}
