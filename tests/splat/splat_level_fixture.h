/* The surface of the view splat at a level above zero, by marching along each ray in double. */
#ifndef SLOSH_SPLAT_LEVEL_FIXTURE_H
#define SLOSH_SPLAT_LEVEL_FIXTURE_H

#include "tests/splat/splat_fixture.h"

#include "sim/kernel/kernel.h"

/* A particle's part of a ray: |x - c|^2 = length2 (z - middle)^2 + beside2 at the depth z, m. */
typedef struct LevelChord {
    size_t particle;
    double middle, beside2, length2, entry;
    double at[3], along[3]; /* x - c = at + (z - middle) along */
} LevelChord;

enum { CHORDS_MAX = 512 };

typedef struct LevelRay {
    const SplatScene *scene;
    double h, volume;
    int count;
    LevelChord chords[CHORDS_MAX];
} LevelRay;

static inline LevelChord level_chord(const SplatScene *scene, const double c[3], const double ray[3])
{
    LevelChord chord = {.length2 = 1, .middle = -c[2], .along = {0, 0, -1}};
    if (splat_def(&scene->def)->shape == SPLAT_PAPER) { /* eq. 5: along the axis */
        for (int k = 0; k < 2; k++)
            chord.at[k] = -c[2] * ray[k] - c[k];
    } else {
        chord.length2 = dot3(ray, ray);
        chord.middle = dot3(ray, c) / chord.length2;
        memcpy(chord.along, ray, sizeof chord.along);
        for (int k = 0; k < 3; k++)
            chord.at[k] = chord.middle * ray[k] - c[k];
    }
    chord.beside2 = dot3(chord.at, chord.at);
    return chord;
}

static inline void level_ray(const SplatScene *scene, double x, double y, LevelRay *out)
{
    const Camera *camera = &scene->frame.camera;
    const double ray[3] = {(2 * (x + 0.5) / scene->width - 1) * camera->tangent[0],
                           (2 * (y + 0.5) / scene->height - 1) * camera->tangent[1], -1};
    const double h = scene->frame.radii.drawn, spacing = scene->state.spacing;
    *out = (LevelRay){.scene = scene, .h = h, .volume = spacing * spacing * spacing};
    for (size_t i = 0; i < scene->particles->count; i++) {
        float at[3];
        memcpy(at, &scene->particles->position[4 * i], sizeof at);
        matrix_transform(scene->frame.box_to_world, at, at);
        matrix_transform(camera->view, at, at);
        LevelChord chord = level_chord(scene, (double[]){at[0], at[1], at[2]}, ray);
        chord.particle = i;
        chord.entry = chord.middle - sqrt(fmax(h * h - chord.beside2, 0) / chord.length2);
        if (chord.beside2 < h * h && chord.entry >= camera->near_plane) { /* not for NaN */
            assert_true(out->count < CHORDS_MAX);
            out->chords[out->count++] = chord;
        }
    }
}

static inline double level_distance(const LevelChord *chord, double z)
{
    const double s = z - chord->middle;
    return sqrt(chord->beside2 + chord->length2 * s * s);
}

/* Eq. 1. */
static inline double level_field(const LevelRay *ray, double z)
{
    double sum = 0;
    for (int i = 0; i < ray->count; i++)
        sum += ray->volume * kernel_poly6(level_distance(&ray->chords[i], z), ray->h);
    return sum;
}

static inline double level_bisect(const LevelRay *ray, double low, double high)
{
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        *(level_field(ray, middle) < splat_def(&ray->scene->def)->level ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

/* The first depth at the level, or 1e30. `near_miss`: how close below the level the field turned before. */
static inline double level_root(const LevelRay *ray, double *near_miss)
{
    const double step = ray->h / 48, level = splat_def(&ray->scene->def)->level;
    double first = 1e30, last = 0, before[2] = {0};
    for (int i = 0; i < ray->count; i++) {
        first = fmin(first, ray->chords[i].entry);
        last = fmax(last, 2 * ray->chords[i].middle - ray->chords[i].entry);
    }
    *near_miss = 1e30;
    for (int i = 0; first + i * step < last + step; i++) {
        const double z = first + i * step, value = level_field(ray, z);
        if (value >= level)
            return level_bisect(ray, z - step, z);
        if (before[1] > before[0] && before[1] > value)
            *near_miss = fmin(*near_miss, level - before[1]);
        before[0] = before[1], before[1] = value;
    }
    return 1e30;
}

/* Eq. 2 and 4 there; unsure where a ray grazes the surface. */
static inline SplatPixel level_wanted(const SplatScene *scene, double x, double y)
{
    static LevelRay ray;
    double near_miss, slope = 0;
    level_ray(scene, x, y, &ray);
    SplatPixel pixel = {.depth = level_root(&ray, &near_miss)};
    pixel.unsure = near_miss < 0.02 * splat_def(&scene->def)->level;
    for (int i = 0; pixel.depth < 1e29 && i < ray.count; i++) {
        const LevelChord *chord = &ray.chords[i];
        const double r = level_distance(chord, pixel.depth), s = pixel.depth - chord->middle;
        const double weight = ray.volume * kernel_poly6(r, ray.h);
        const double change = ray.volume * density_kernel_find("poly6")->derivative(r, ray.h) / r;
        const float *color = scene->world.fluids[scene->particles->fluid[chord->particle]].color;
        pixel.weight += weight;
        slope += change * chord->length2 * s * ray.h;
        for (int k = 0; k < 3; k++) {
            pixel.color[k] += weight * color[k];
            pixel.normal[k] -= change * (chord->at[k] + s * chord->along[k]) * ray.h; /* a radius */
        }
    }
    pixel.unsure |= pixel.depth < 1e29 && slope < splat_def(&scene->def)->level;
    return pixel;
}

/* Every `stride`th pixel both ways: depth to 1e-4 of the radius. Returns how many were compared that are
 * covered. */
static inline int level_compare(SplatScene *scene, int stride)
{
    SplatPixel *drawn = splat_drawn(scene);
    int covered = 0;
    for (int i = 0; i < scene->width * scene->height; i++) {
        const int x = i % scene->width, y = i / scene->width;
        if (x % stride || y % stride)
            continue;
        const SplatPixel wanted = level_wanted(scene, x, y);
        SplatPixel snap;
        if (wanted.unsure || !splat_snap(scene, level_wanted, x, y, &wanted, &snap))
            continue;
        covered += wanted.depth < 1e29;
        const double slack =
            snap.depth + (snaps() ? 2e-4 : 1e-4) * scene->frame.radii.drawn + 5e-7 * wanted.depth;
        if (fabs(drawn[i].depth - wanted.depth) > slack)
            fail_msg("pixel %d %d: depth %.9g, by marching %.9g", x, y, drawn[i].depth, wanted.depth);
        if (fabs(drawn[i].weight - wanted.weight) > 1e-3 * splat_def(&scene->def)->level + snap.weight)
            fail_msg("pixel %d %d: field %g, wanted %g", x, y, drawn[i].weight, wanted.weight);
        const double rounding = 3e-3 * splat_rounding();
        const double most = rounding * sqrt(dot3(wanted.normal, wanted.normal));
        for (int k = 0; k < 3; k++)
            if (fabs(drawn[i].color[k] - wanted.color[k]) > rounding * wanted.weight + snap.color[k] ||
                fabs(drawn[i].normal[k] - wanted.normal[k]) > most + snap.normal[k])
                fail_msg("pixel %d %d, component %d: colour %g, eq. 2 %g; normal %g, eq. 4 %g", x, y, k,
                         drawn[i].color[k], wanted.color[k], drawn[i].normal[k], wanted.normal[k]);
    }
    free(drawn);
    return covered;
}

#endif
