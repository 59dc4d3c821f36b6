#include "sim/body/body_hull.h"

#include "sim/mesh/mesh_shape.h"

#include <math.h>

enum { RIM = 32, SHELL = 96, DIRECTIONS = BODY_POINTS, EDGE = 3 };

static void put(BodyHull *hull, double x, double y, double z)
{
    double *to = hull->point[hull->count++];
    to[0] = x, to[1] = y, to[2] = z;
}

/* The corners, and EDGE points between neighbouring corners; `flat`: a rectangle. */
static void hull_of_box(BodyHull *hull, const double size[3], bool flat)
{
    enum { STEPS = EDGE + 1 };
    const int deep = flat ? 0 : STEPS;
    for (int i = 0; i <= STEPS; i++)
        for (int j = 0; j <= STEPS; j++)
            for (int k = 0; k <= deep; k++) {
                const int ends = (i % STEPS == 0) + (j % STEPS == 0) + (!flat && k % STEPS == 0);
                if (ends >= (flat ? 1 : 2))
                    put(hull, size[0] * ((double)i / STEPS - 0.5), size[1] * ((double)j / STEPS - 0.5),
                        flat ? 0 : size[2] * ((double)k / STEPS - 0.5));
            }
}

static void put_rim(BodyHull *hull, double radius, double y)
{
    for (int i = 0; i < RIM; i++)
        put(hull, radius * cos(2 * M_PI * i / RIM), y, radius * sin(2 * M_PI * i / RIM));
}

static void direction(int i, int count, double low, double out[3])
{
    const double y = low + (1 - low) * (i + 0.5) / count, across = sqrt(1 - y * y),
                 angle = M_PI * (3 - sqrt(5)) * i;
    out[0] = across * cos(angle), out[1] = y, out[2] = across * sin(angle);
}

static void hull_of_bowl(BodyHull *hull, double outer, bool flat)
{
    if (flat) {
        for (int i = 0; i <= RIM; i++)
            put(hull, outer * cos(M_PI * i / RIM), -outer * sin(M_PI * i / RIM), 0);
        return;
    }
    put_rim(hull, outer, 0);
    for (int i = 0; i < SHELL; i++) {
        double d[3];
        direction(i, SHELL, 0, d);
        put(hull, outer * d[0], -outer * d[1], outer * d[2]);
    }
}

static bool has(const BodyHull *hull, const double x[3])
{
    for (int i = 0; i < hull->count; i++)
        if (hull->point[i][0] == x[0] && hull->point[i][1] == x[1] && hull->point[i][2] == x[2])
            return true;
    return false;
}

static void hull_of_mesh(BodyHull *hull, const MeshUse *mesh)
{
    const Triangles *all = &mesh->shape->triangles;
    for (int i = 0; i < DIRECTIONS; i++) {
        double d[3], most = -INFINITY, x[3] = {0};
        size_t best = 0;
        direction(i, DIRECTIONS, -1, d);
        for (size_t v = 0; v < all->vertex_count; v++) {
            const float *at = all->vertex[v];
            const double along = d[0] * (double)at[0] + d[1] * (double)at[1] + d[2] * (double)at[2];
            best = along > most ? v : best;
            most = fmax(most, along);
        }
        for (int k = 0; k < 3; k++)
            x[k] = mesh->scale * (double)all->vertex[best][k];
        if (!has(hull, x))
            put(hull, x[0], x[1], x[2]);
    }
}

void body_hull(const SolidDef *solid, int dimensions, BodyHull *hull)
{
    const bool flat = dimensions == 2;
    *hull = (BodyHull){.count = 0};
    switch (solid->kind) {
    case SOLID_BOX:
        hull_of_box(hull, solid->size, flat);
        break;
    case SOLID_CYLINDER:
        put_rim(hull, solid->radius, -0.5 * solid->height);
        put_rim(hull, solid->radius, 0.5 * solid->height);
        break;
    case SOLID_BOWL:
        hull_of_bowl(hull, solid->radius + solid->thickness, flat);
        break;
    case SOLID_MESH:
        hull_of_mesh(hull, &solid->mesh);
        break;
    default:
        put(hull, 0, 0, 0);
        hull->radius = solid->radius;
    }
}
