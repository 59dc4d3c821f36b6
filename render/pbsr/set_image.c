#include "render/pbsr/set_image.h"

#include <math.h>
#include <string.h>

/* The eye is where all three rows are 0: Cramer's rule. */
void set_sight_find_eye(SetSight *sight)
{
    const float *a = sight->row[0], *b = sight->row[1], *c = sight->row[2];
    double of[4]; /* the determinant, and the determinants with a column replaced by the last column */
    for (int n = 0; n < 4; n++) {
        const int x = n == 1 ? 3 : 0, y = n == 2 ? 3 : 1, z = n == 3 ? 3 : 2;
        of[n] = (double)a[x] * ((double)b[y] * (double)c[z] - (double)b[z] * (double)c[y]) -
                (double)a[y] * ((double)b[x] * (double)c[z] - (double)b[z] * (double)c[x]) +
                (double)a[z] * ((double)b[x] * (double)c[y] - (double)b[y] * (double)c[x]);
    }
    for (int k = 0; k < 3; k++)
        sight->eye[k] = (float)(-of[k + 1] / of[0]);
}

float set_sight_boost(const SetSight *sight, const float at[3], const float normal[3])
{
    float dot = 0, own = 0, away = 0;
    for (int k = 0; k < 3; k++) {
        const float to = sight->eye[k] - at[k];
        dot += normal[k] * to;
        own += normal[k] * normal[k];
        away += to * to;
    }
    if (!(own > 0 && away > 0))
        return 1;
    const float open = 1 - fminf(fabsf(dot) / sqrtf(own * away), 1), square = open * open;
    return 1 + sight->edges * square * square;
}

void set_image_clear(const SetImage *image, const SetSight *sight)
{
    const int rows = sight->height - image->below - image->above;
    memset(image->depth, 0, (size_t)sight->width * (size_t)rows * sizeof *image->depth);
}

static uint32_t folded(float a, float sum)
{
    return (uint32_t)((0.5F + 0.5F * a / sum) * 1023 + 0.5F);
}

/* Seen from +z, the upper half is the inner square; the lower half is folded outwards. */
static uint32_t normal_bits(const float n[3])
{
    const float x = n[0], y = n[1], sum = fabsf(x) + fabsf(y) + fabsf(n[2]);
    if (!(sum > 0 && sum < INFINITY))
        return folded(0, 1) | folded(0, 1) << 10;
    if (n[2] >= 0)
        return folded(x, sum) | folded(y, sum) << 10;
    return folded(copysignf(sum - fabsf(y), x), sum) | folded(copysignf(sum - fabsf(x), y), sum) << 10;
}

static uint32_t value_bits(float value, const SetSight *sight)
{
    const float share = (value - sight->low) * sight->scale;
    return share < 0 ? 0 : share <= 1 ? (uint32_t)(share * 254 + 0.5F) : share > 1 ? 254 : 255;
}

uint32_t set_word(const LayerPoint *point, const SetSight *sight, unsigned layer)
{
    return normal_bits(point->normal) | value_bits(point->value, sight) << 20 | layer << 28;
}

/* Converts a coordinate from 16 bits, signed, to 10 bits, unsigned. */
static uint32_t fewer_bits(uint32_t half)
{
    return (uint32_t)((float)(int16_t)half * (511.5F / 32767) + 512);
}

uint32_t set_word_of_point(const SurfacePoint *point, const SetSight *sight)
{
    return fewer_bits(point->normal & 0xffff) | fewer_bits(point->normal >> 16) << 10 |
           value_bits(point->value, sight) << 20 | point->surface << 28;
}

static float row_at(const float row[4], const float at[3])
{
    return row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
}

bool set_image_spot(const SetImage *image, const SetSight *sight, const float at[3], SetSpot *spot)
{
    const float w = row_at(sight->row[2], at), by = 1 / w;
    const float x = row_at(sight->row[0], at) * by, y = row_at(sight->row[1], at) * by;
    if (!(w > sight->near_plane && x >= 0 && x < (float)sight->width && y >= (float)image->below &&
          y < (float)(sight->height - image->above))) /* false for NaN */
        return false;
    const float deep = sight->near_plane * by;
    spot->pixel = (size_t)((int)y - image->below) * (size_t)sight->width + (size_t)(int)x;
    memcpy(&spot->depth, &deep, sizeof deep);
    return true;
}

void set_image_add(const SetImage *image, const SetSight *sight, const LayerPoint *point, unsigned layer)
{
    SetSpot spot;
    if (point->inside >= 0 && set_image_spot(image, sight, point->at, &spot) && set_image_open(image, &spot))
        set_image_put(image, &spot, set_word(point, sight, layer));
}
