#include "sim/matter/fill.h"

#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <string.h>

double fill_volume(const Fill *fill, int dimensions)
{
    const double r = fill->radius, depth = dimensions == 3 ? fill->max[2] - fill->min[2] : 1;
    if (fill->kind == FILL_CYLINDER)
        return M_PI * r * r * fill->height;
    if (fill->kind == FILL_MESH)
        return fill->mesh.shape ? pow(fill->mesh.scale, 3) * fill->mesh.shape->volume : 0;
    if (fill->kind == FILL_BALL)
        return dimensions == 3 ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
    return (fill->max[0] - fill->min[0]) * (fill->max[1] - fill->min[1]) * depth;
}

/* Rows of the rotation from the box's frame to the mesh's frame. */
static void mesh_rows(const Fill *fill, double row[3][3])
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double q[4];
    solid_turn(fill->axis, fill->angle_deg, q);
    for (int k = 0; k < 3; k++)
        quat_rotate(q, axes[k], row[k]);
}

/* Reach of a mesh from its middle along an axis of the box, m. */
static double mesh_reach(const Fill *fill, int axis)
{
    double row[3][3], reach = 0;
    mesh_rows(fill, row);
    for (int k = 0; k < 3 && fill->mesh.shape; k++)
        reach += fabs(row[k][axis]) * fill->mesh.scale * fill->mesh.shape->half[k];
    return reach;
}

void fill_bounds(const Fill *fill, double low[3], double high[3])
{
    const double *a = fill->axis, length2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    for (int k = 0; k < 3; k++) {
        if (fill->kind == FILL_BLOCK) {
            low[k] = fill->min[k];
            high[k] = fill->max[k];
            continue;
        }
        double reach = fill->kind == FILL_MESH ? mesh_reach(fill, k) : fill->radius;
        if (fill->kind == FILL_CYLINDER) {
            const double along2 = a[k] * a[k] / length2;
            reach = 0.5 * fill->height * sqrt(along2) + fill->radius * sqrt(fmax(0, 1 - along2));
        }
        low[k] = fill->centre[k] - reach;
        high[k] = fill->centre[k] + reach;
    }
}

static bool cylinder_holds(const Fill *fill, const double x[3])
{
    double r2 = 0, along = 0, length2 = 0;
    for (int k = 0; k < 3; k++) {
        const double d = x[k] - fill->centre[k];
        r2 += d * d;
        along += d * fill->axis[k];
        length2 += fill->axis[k] * fill->axis[k];
    }
    const double along2 = along * along / length2;
    return along2 <= 0.25 * fill->height * fill->height && r2 - along2 <= fill->radius * fill->radius;
}

static bool mesh_holds(const Fill *fill, const double x[3])
{
    const double d[3] = {x[0] - fill->centre[0], x[1] - fill->centre[1], x[2] - fill->centre[2]};
    double row[3][3], at[3];
    mesh_rows(fill, row);
    for (int k = 0; k < 3; k++)
        at[k] = row[k][0] * d[0] + row[k][1] * d[1] + row[k][2] * d[2];
    return mesh_use_distance(&fill->mesh, at) <= 0;
}

/* Lattice points ask for the same few formulas in a row, and a column of points for the same height. So each
   thread keeps the formulas read last, and the last value of each. */
enum { FORMULAS_KEPT = 4 };
typedef struct Height {
    char text[FORMULA_SIZE];
    Formula formula; /* no steps: the text is no valid formula */
    double x, z, y;
} Height;

static void height_read(Height *height, const char *text)
{
    Error error;
    *height = (Height){.x = NAN};
    memcpy(height->text, text, strlen(text) + 1);
    if (!formula_read(text, "xz", &height->formula, &error))
        height->formula.count = 0;
}

static Height *height_of(const char text[FORMULA_SIZE])
{
    static _Thread_local Height kept[FORMULAS_KEPT];
    static _Thread_local int last, next;
    if (strcmp(kept[last].text, text) == 0)
        return &kept[last];
    for (last = 0; last < FORMULAS_KEPT; last++)
        if (strcmp(kept[last].text, text) == 0)
            return &kept[last];
    last = next;
    next = (next + 1) % FORMULAS_KEPT;
    height_read(&kept[last], text);
    return &kept[last];
}

bool fill_ends(const Fill *fill, double x, double z, double *y)
{
    if (fill->heights) {
        *y = field_table_at(fill->heights, 0, (double[]){x, 0, z});
        return true;
    }
    if (!formula_given(fill->below) || strlen(fill->below) >= FORMULA_SIZE) /* the name of a table */
        return false;
    Height *height = height_of(fill->below);
    if (height->formula.count == 0)
        return false;
    if (height->x != x || height->z != z) {
        height->y = formula_value(&height->formula, (double[]){x, z});
        height->x = x, height->z = z;
    }
    *y = height->y;
    return true;
}

static bool shape_holds(const Fill *fill, int dimensions, const double x[3], double tolerance)
{
    const int axes = dimensions == 2 ? 2 : 3;
    if (fill->kind == FILL_BLOCK) {
        for (int k = 0; k < axes; k++)
            if (x[k] < fill->min[k] - tolerance || x[k] >= fill->max[k] - tolerance)
                return false;
        return true;
    }
    if (fill->kind == FILL_CYLINDER)
        return cylinder_holds(fill, x);
    if (fill->kind == FILL_MESH)
        return mesh_holds(fill, x);
    double r2 = 0;
    for (int k = 0; k < axes; k++)
        r2 += (x[k] - fill->centre[k]) * (x[k] - fill->centre[k]);
    return r2 <= fill->radius * fill->radius;
}

bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance)
{
    double end; /* last: a formula is costly */
    return shape_holds(fill, dimensions, x, tolerance) && (!fill_ends(fill, x[0], x[2], &end) || x[1] < end);
}
