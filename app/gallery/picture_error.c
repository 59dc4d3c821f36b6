/* after: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error
   visibility to structural similarity", 2004 */
#include "app/gallery/picture_error.h"

#include "sim/base/color.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

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
