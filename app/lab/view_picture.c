/* after: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error
   visibility to structural similarity", 2004 */
#include "app/base/program.h"
#include "app/lab/view_benchmark.h"
#include "app/run/offscreen.h"
#include "sim/base/base.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 8 };

bool linear_picture_make(LinearPicture *picture, const uint8_t *srgb, int width, int height, int factor)
{
    double light[256];
    const size_t line = 3 * (size_t)width * (size_t)factor;
    *picture = (LinearPicture){width, height, malloc(3 * (size_t)width * (size_t)height * sizeof(float))};
    if (!picture->rgb)
        return false;
    for (int i = 0; i < 256; i++)
        light[i] = srgb_to_linear(i / 255.0);
    for (int y = 0; y < height; y++)
        for (int k = 0; k < 3 * width; k++) {
            const uint8_t *first =
                srgb + (size_t)y * (size_t)factor * line + 3 * (size_t)(k / 3) * (size_t)factor + k % 3;
            double sum = 0;
            for (int j = 0; j < factor; j++)
                for (int i = 0; i < factor; i++)
                    sum += light[first[(size_t)j * line + 3 * (size_t)i]];
            picture->rgb[(size_t)y * 3 * (size_t)width + (size_t)k] = (float)(sum / (factor * factor));
        }
    return true;
}

void linear_picture_free(LinearPicture *picture)
{
    free(picture->rgb);
    *picture = (LinearPicture){0};
}

double picture_rms(const LinearPicture *a, const LinearPicture *b)
{
    double sum = 0;
    const size_t count = 3 * (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < count; i++) {
        const double off = (double)a->rgb[i] - (double)b->rgb[i];
        sum += off * off;
    }
    return sqrt(sum / (double)count);
}

/* Perceived brightness, 0 .. 1, with the weights of Rec. 709. */
static double luma(const LinearPicture *picture, int x, int y)
{
    const float *rgb = picture->rgb + 3 * ((size_t)y * (size_t)picture->width + (size_t)x);
    return linear_to_srgb(0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2]);
}

/* eq. 13, for the block at x0, y0. */
static double ssim(const LinearPicture *a, const LinearPicture *b, int x0, int y0)
{
    static const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double n = 0, sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
    for (int y = y0; y < y0 + BLOCK && y < a->height; y++)
        for (int x = x0; x < x0 + BLOCK && x < a->width; x++) {
            const double p = luma(a, x, y), q = luma(b, x, y);
            n++;
            sum_a += p;
            sum_b += q;
            aa += p * p;
            bb += q * q;
            ab += p * q;
        }
    const double ma = sum_a / n, mb = sum_b / n;
    const double va = aa / n - ma * ma, vb = bb / n - mb * mb, cov = ab / n - ma * mb;
    return (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

double picture_structure(const LinearPicture *a, const LinearPicture *b)
{
    double sum = 0;
    int blocks = 0;
    for (int y = 0; y < a->height; y += BLOCK)
        for (int x = 0; x < a->width; x += BLOCK, blocks++)
            sum += ssim(a, b, x, y);
    return fmax(1 - sum / blocks, 0); /* below 0 by rounding only */
}

enum { PICTURES = 7, WARM_UP = 2, ENOUGH_MS = 1000, PIXELS_MOST = 1 << 24 };

int view_picture_factor(int width, int height)
{
    GLint texture = 0, viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    int factor = VIEW_PICTURE_FACTOR;
    while (factor > 1 &&
           (factor * width > texture || factor * height > texture || factor * width > viewport[0] ||
            factor * height > viewport[1] || (double)factor * width * factor * height > PIXELS_MOST))
        factor--;
    return factor;
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
    qsort(sums + first, (size_t)count, sizeof *sums, compare_numbers);
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

bool view_picture_draw(const Scene *scene, World *world, int width, int height, int factor, bool timed,
                       ViewPicture *out, Error *error)
{
    Offscreen offscreen;
    GlTimer *timer = NULL;
    *out = (ViewPicture){.ms = (double)NAN};
    bool ok = offscreen_open(&offscreen, &scene->view, &scene->world, world, factor * width, factor * height,
                             error);
    if (ok && !(timer = gl_timer_create(GL_CLOCK_AUTO)))
        ok = error_set(error, "no memory for the clock of the stages");
    if (ok)
        snprintf(out->clock, sizeof out->clock, "%s", gl_timer_clock_name(timer));
    ok = ok && draw_all(&offscreen, world, timer, timed ? WARM_UP + PICTURES : 1, &out->ms, error) &&
         read_picture(&offscreen, width, height, factor, &out->picture, error);
    gl_timer_destroy(timer);
    offscreen_close(&offscreen);
    return ok;
}
