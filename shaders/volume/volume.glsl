#include "shaders/volume/volume_block.h"

vec3 cells_of(vec3 box_point)
{
    return (box_point - volume_corner) * cells_per_m;
}

// (1 - r^2 / h^2)^3 from `rest` = 1 - r^2 / h^2: poly6 of Müller 2003, eq. 20, without the factor.
float poly6_shape(float rest)
{
    float t = max(rest, 0.0);
    return t * t * t;
}
