/* Equidistant stops as published: viridis, inferno and plasma by van der Walt and Smith (matplotlib),
   turbo by Mikhailov (2019), coolwarm by Moreland (2009), mako by Waskom (seaborn, 2021). Mako starts at
   two fifths of its length: the first part is darker than the start of viridis. A Catmull-Rom curve
   interpolates between the stops. */
#include "render/frame/frame.h"

#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>
#include <string.h>

typedef struct Colormap {
    const char *name;
    int count;
    uint32_t stops[17];
} Colormap;

const char *const colormap_choices[] = {"auto",  "viridis", "inferno", "plasma", "coolwarm",
                                        "turbo", "mako",    "gray",    NULL};
const char *const *const colormap_list = colormap_choices + 1;

/* Speed: mako, blue at rest and bright if fast, as water looks. All other scalars: viridis, which most
   readers know. */
const char *colormap_of(const char *name, Scalar scalar)
{
    if (strcmp(name, colormap_choices[0]) != 0)
        return name;
    return scalar == SCALAR_SPEED ? "mako" : "viridis";
}

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
    {"mako",
     10,
     {0x395d9c, 0x3671a0, 0x3484a5, 0x3497a9, 0x38aaac, 0x45bdad, 0x60ceac, 0x91dbb4, 0xbbe7c8, 0xdef5e5}},
    {"gray", 2, {0x000000, 0xffffff}},
};

static double stop_channel(const Colormap *map, int stop, int channel)
{
    int held = stop < 0 ? 0 : stop >= map->count ? map->count - 1 : stop;
    double value = map->stops[held] >> (16 - 8 * channel) & 255;
    if (held == stop)
        return value;
    /* extrapolate linearly beyond the ends */
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

static const Colormap *colormap_find(const char *name)
{
    for (size_t i = 0; i < sizeof colormaps / sizeof colormaps[0]; i++)
        if (strcmp(colormaps[i].name, name) == 0)
            return &colormaps[i];
    return NULL;
}

bool colormap_fill_bent(const char *name, const ControlPoints *curve, uint8_t rgb[3 * COLORMAP_SIZE])
{
    const Colormap *map = colormap_find(name);
    for (int entry = 0; map && entry < COLORMAP_SIZE; entry++) {
        const double at = (map->count - 1.0) * control_points_at(curve, (double)entry / (COLORMAP_SIZE - 1));
        for (int k = 0; k < 3; k++)
            rgb[3 * entry + k] = channel_at(map, at, k);
    }
    return map != NULL;
}

bool colormap_fill(const char *name, uint8_t rgb[3 * COLORMAP_SIZE])
{
    const ControlPoints straight = control_points_straight();
    return colormap_fill_bent(name, &straight, rgb);
}

static void fill_texture(ColorTable *table, const ControlPoints *curve)
{
    uint8_t rgb[3 * COLORMAP_SIZE];
    colormap_fill_bent(table->name, curve, rgb);
    table->curve = *curve;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(table->texture, 0, 0, 0, COLORMAP_SIZE, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb);
}

bool color_table_create(ColorTable *table, const char *name, const ControlPoints *curve, Error *error)
{
    const Colormap *map = colormap_find(name);
    *table = (ColorTable){.name = map ? map->name : NULL};
    if (!map)
        return error_set(error, "unknown colormap \"%s\"; viridis is the default", name);
    glCreateTextures(GL_TEXTURE_2D, 1, &table->texture);
    glObjectLabel(GL_TEXTURE, table->texture, -1, "colormap");
    glTextureStorage2D(table->texture, 1, GL_SRGB8_ALPHA8, COLORMAP_SIZE, 1);
    glTextureParameteri(table->texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(table->texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    fill_texture(table, curve);
    return true;
}

void color_table_destroy(ColorTable *table)
{
    glDeleteTextures(1, &table->texture);
    *table = (ColorTable){.texture = 0};
}

void color_table_bind(ColorTable *table, const ControlPoints *curve)
{
    if (!control_points_equal(&table->curve, curve))
        fill_texture(table, curve);
    glBindTextureUnit(COLORMAP_UNIT, table->texture);
}

void color_table_update(ColorTable *table, const char *name, const ControlPoints *curve)
{
    Error unknown;
    if (!table->name || strcmp(table->name, name) != 0) {
        color_table_destroy(table);
        if (!color_table_create(table, name, curve, &unknown))
            return;
    }
    color_table_bind(table, curve);
}
