#include "app/gallery/shot.h"

#include "app/run/offscreen.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURES = 7, WARM_UP = 2, ENOUGH_MS = 1000, PIXELS_MOST = 1 << 24 };

int shot_factor(int width, int height)
{
    GLint texture = 0, viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    int factor = SHOT_FACTOR;
    while (factor > 1 &&
           (factor * width > texture || factor * height > texture || factor * width > viewport[0] ||
            factor * height > viewport[1] || (double)factor * width * factor * height > PIXELS_MOST))
        factor--;
    return factor;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Time of all stages of a picture. */
static double sum_of(const StageTimes *times)
{
    double sum = 0;
    for (int s = 0; s < STAGE_COUNT; s++)
        sum += stage_part((Stage)s) == PART_RENDER ? times->ms[s] : 0;
    return sum;
}

/* The first pictures fill caches, and make the backdrop copied by later pictures. Slow pictures are drawn
   fewer times. */
static bool draw_all(Offscreen *offscreen, World *world, GlTimer *timer, int pictures, double *ms,
                     Error *error)
{
    double sums[WARM_UP + PICTURES];
    StageTimes times = {0};
    int known = 0, drawn = 0;
    const double began = wall_ms();
    while (drawn < pictures && (drawn < WARM_UP + 1 || wall_ms() - began < ENOUGH_MS)) {
        drawn++;
        if (!offscreen_draw(offscreen, world, NULL, timer, error))
            return false;
        if (gl_timer_frame(timer, &times))
            sums[known++] = sum_of(&times);
    }
    while (known < drawn && gl_timer_drain(timer, &times))
        sums[known++] = sum_of(&times);
    const int first = known > WARM_UP ? WARM_UP : 0, count = known - first;
    qsort(sums + first, (size_t)count, sizeof *sums, ascending);
    *ms = count > 0 ? sums[first] : (double)NAN; /* least time: other load of the machine only adds */
    return true;
}

static bool read_picture(const Offscreen *offscreen, int width, int height, int factor,
                         LinearPicture *picture, Error *error)
{
    uint8_t *rgb = malloc(3 * (size_t)(factor * width) * (size_t)(factor * height));
    if (rgb)
        renderer_read(offscreen->renderer, rgb);
    const bool ok = rgb && linear_picture_make(picture, rgb, width, height, factor);
    free(rgb);
    return ok || error_set(error, "no memory for a picture of %d x %d", factor * width, factor * height);
}

bool shoot(const Scene *scene, World *world, int width, int height, int factor, bool timed, Shot *shot,
           Error *error)
{
    Offscreen offscreen;
    GlTimer *timer = NULL;
    *shot = (Shot){.ms = (double)NAN};
    bool ok = offscreen_open(&offscreen, &scene->view, &scene->world, world, factor * width, factor * height,
                             error);
    if (ok && !(timer = gl_timer_create(GL_CLOCK_AUTO)))
        ok = error_set(error, "no memory for the clock of the stages");
    if (ok)
        snprintf(shot->clock, sizeof shot->clock, "%s", gl_timer_clock_name(timer));
    ok = ok && draw_all(&offscreen, world, timer, timed ? WARM_UP + PICTURES : 1, &shot->ms, error) &&
         read_picture(&offscreen, width, height, factor, &shot->picture, error);
    gl_timer_destroy(timer);
    offscreen_close(&offscreen);
    return ok;
}
