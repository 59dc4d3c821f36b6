#include "render/pbsr/opacity.h"

#include <math.h>

static double clamped(double alpha)
{
    return fmax(0, fmin(alpha, OPACITY_MOST));
}

double opacity_of_points(double n, double part, double theta)
{
    const double tilted = part / cos(theta);
    if (!(n > 0))
        return 0;
    return tilted < 1 ? -expm1(n * log1p(-tilted)) : 1;
}

double points_of_opacity(double alpha, double part)
{
    return log1p(-clamped(alpha)) / log1p(-part);
}

double point_density_of_opacity(double alpha, double pixel)
{
    return -log1p(-clamped(alpha)) / pixel;
}

double points_of_area(double alpha, double pixel, double area, int sets)
{
    return sets * area * point_density_of_opacity(alpha, pixel);
}

double pixel_area(const float tangent[2], int width, int height, double depth)
{
    return 2.0 * depth * (double)tangent[0] / width * (2.0 * depth * (double)tangent[1] / height);
}

double opacity_noise(double alpha, int sets)
{
    return sqrt(alpha * (1 - alpha) / sets);
}
