#include "sim/start/start.h"

#include "sim/mesh/mesh_shape.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { SPREAD = 3 /* greatest difference from the number of layers by the spacing */ };

/* In spacings: fills nearer than `near` touch; a face nearer than `on_face` to a layer's face is on the
   layer's face; `slack` as in sim/start/seed.c. */
static const double near = 0.75, on_face = 1e-3, slack = 1e-6;

/* A group of FillGroups. */
typedef struct BlockGroup {
    int count;
    bool has_block;
    double low[3], high[3]; /* outermost faces of the group's blocks, m */
    const Fill *fills[FILLS_ALL];
} BlockGroup;

static double wall_low(const WorldDef *def, int k)
{
    return k == 1 ? 0 : -0.5 * def->box_size[k];
}

/* A face of a block, limited to the box, m. */
static double face_of(const WorldDef *def, const Fill *fill, int k, int side)
{
    const double wall = wall_low(def, k), face = side ? fill->max[k] : fill->min[k];
    return fmin(fmax(face, wall), wall + def->box_size[k]);
}

static bool fills_touch(const WorldDef *def, const Fill *a, const Fill *b)
{
    double low[2][3] = {{0}}, high[2][3] = {{0}};
    assert(def->dimensions <= 3);
    fill_bounds(a, low[0], high[0]);
    fill_bounds(b, low[1], high[1]);
    for (int k = 0; k < def->dimensions; k++)
        if (fmax(low[0][k], low[1][k]) - fmin(high[0][k], high[1][k]) > near * def->spacing)
            return false;
    return true;
}

static bool blocks_overlap(const WorldDef *def, const Fill *a, const Fill *b)
{
    for (int k = 0; k < def->dimensions; k++)
        if (fmin(a->max[k], b->max[k]) - fmax(a->min[k], b->min[k]) <= on_face * def->spacing)
            return false;
    return true;
}

/* True if there are only blocks, without overlaps. */
static bool is_pile(const WorldDef *def, const Fill *const *fills, int count)
{
    for (int i = 0; i < count; i++)
        for (int j = 0; j <= i; j++)
            if (fills[i]->kind != FILL_BLOCK || (j < i && blocks_overlap(def, fills[i], fills[j])))
                return false;
    return true;
}

/* Makes the group that begins with fill `first`. */
static void group_make(const WorldDef *def, FillGroups *groups, int first)
{
    const Fill *members[FILLS_ALL];
    int count = 1;
    members[0] = groups->fill[first];
    groups->group[first] = first;
    for (int member = 0; member < count; member++)
        for (int other = first + 1; other < groups->count; other++)
            if (groups->group[other] < 0 && fills_touch(def, members[member], groups->fill[other])) {
                groups->group[other] = first;
                members[count++] = groups->fill[other];
            }
    groups->pile[first] = is_pile(def, members, count);
}

void fill_groups(const WorldDef *def, FillGroups *groups)
{
    groups->count = 0;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++) {
            groups->fill[groups->count] = &def->fluids[f].fills[i];
            groups->group[groups->count++] = -1;
        }
    for (int fill = 0; fill < groups->count; fill++)
        if (groups->group[fill] < 0)
            group_make(def, groups, fill);
}

static void group_add(const WorldDef *def, BlockGroup *group, const Fill *fill)
{
    group->fills[group->count++] = fill;
    if (fill->kind != FILL_BLOCK)
        return;
    for (int k = 0; k < 3; k++) {
        const double low = face_of(def, fill, k, 0), high = face_of(def, fill, k, 1);
        group->low[k] = group->has_block ? fmin(group->low[k], low) : low;
        group->high[k] = group->has_block ? fmax(group->high[k], high) : high;
    }
    group->has_block = true;
}

/* The group of a fill, in the order of numbers. */
static void group_of(const WorldDef *def, const FillGroups *groups, int fill, BlockGroup *group)
{
    group->count = 0;
    group->has_block = false;
    for (int other = groups->group[fill]; other < groups->count; other++)
        if (groups->group[other] == groups->group[fill])
            group_add(def, group, groups->fill[other]);
}

/* Axis k of the box's lattice. */
static FillAxis box_axis(const WorldDef *def, int k)
{
    /* the lattice continues across a periodic side without a seam */
    const double size = def->box_size[k], whole = fmax(1, round(size / def->spacing));
    const double s = def->periodic[k] ? size / whole : def->spacing;
    const double points = def->periodic[k] ? whole : floor(size / s + on_face);
    return (FillAxis){.first = k == 1 ? 0.5 * s : -0.5 * (points - 1) * s, .step = s, .end = (long)points};
}

/* Greatest distance of a face of the group's blocks from the nearest face of a layer, in layers. */
static double misfit(const WorldDef *def, const BlockGroup *group, int k, double first, double step)
{
    double worst = 0;
    for (int i = 0; i < group->count; i++) {
        const Fill *fill = group->fills[i];
        for (int side = 0; side < 2 && fill->kind == FILL_BLOCK; side++) {
            const double layers = (face_of(def, fill, k, side) - first) / step + 0.5;
            worst = fmax(worst, fabs(layers - round(layers)));
        }
    }
    return worst;
}

/* Volume of a point over spacing^3; in two dimensions the area's over spacing^2. */
static double cell_of(const WorldDef *def, const FillAxis axes[3])
{
    double cell = 1;
    for (int k = 0; k < def->dimensions; k++)
        cell *= axes[k].step / def->spacing;
    return cell;
}

/* Candidates for an axis: the box's layers, or whole numbers of layers between the outermost faces. */
typedef struct StepChoice {
    int count;
    FillAxis axis[2 * SPREAD + 1];
    /* difference of the step from the spacing, plus misfit of the group's inner faces */
    double cost[2 * SPREAD + 1];
} StepChoice;

static FillAxis whole_layers(const WorldDef *def, const BlockGroup *group, int k, double n)
{
    const double step = (group->high[k] - group->low[k]) / n, first = group->low[k] + 0.5 * step;
    const double wall = wall_low(def, k);
    return (FillAxis){.first = first,
                      .step = step,
                      .begin = (long)ceil((wall - first) / step + 0.5 - on_face),
                      .end = (long)floor((wall + def->box_size[k] - first) / step - 0.5 + on_face) + 1};
}

static void choice_add(const WorldDef *def, const BlockGroup *group, int k, const FillAxis *axis,
                       StepChoice *choice)
{
    const double off = group->has_block ? misfit(def, group, k, axis->first, axis->step) : 0;
    choice->cost[choice->count] = (off > on_face ? off : 0) + fabs(log(axis->step / def->spacing));
    choice->axis[choice->count++] = *axis;
}

static void choose_from(const WorldDef *def, const BlockGroup *group, int k, StepChoice *choice)
{
    const FillAxis box = box_axis(def, k);
    choice->count = 0;
    if (!group->has_block || misfit(def, group, k, box.first, box.step) <= on_face) {
        choice_add(def, group, k, &box, choice);
        return;
    }
    const long about = lround((group->high[k] - group->low[k]) / def->spacing);
    if (about < 1) {
        choice_add(def, group, k, &(FillAxis){.first = group->low[k], .step = def->spacing}, choice);
        return;
    }
    const long most = about < 50 ? 1 : about < 75 ? 2 : SPREAD; /* about 4 % */
    for (long n = about > most ? about - most : 1; n <= about + most; n++) {
        const FillAxis axis = whole_layers(def, group, k, (double)n);
        choice_add(def, group, k, &axis, choice);
    }
}

/* Choose the layers whose volume per point is nearest to a particle's, then the most even layers. */
static void group_axes(const WorldDef *def, const BlockGroup *group, FillAxis axes[3])
{
    static const double weight = 4; /* weight of the volume */
    const int depth = def->dimensions == 3;
    StepChoice choice[3] = {{0}};
    double least = INFINITY;
    for (int k = 0; k < 2 + depth; k++)
        choose_from(def, group, k, &choice[k]);
    if (!depth)
        choice[2] = (StepChoice){.count = 1, .axis = {{.step = def->spacing, .end = 1}}};
    for (int k = 0; k < 3; k++)
        axes[k] = choice[k].axis[0];
    for (int a = 0; a < choice[0].count; a++)
        for (int b = 0; b < choice[1].count; b++)
            for (int c = 0; c < choice[2].count; c++) {
                const FillAxis try[3] = {choice[0].axis[a], choice[1].axis[b], choice[2].axis[c]};
                const double cost = weight * fabs(log(cell_of(def, try))) + choice[0].cost[a] +
                                    choice[1].cost[b] + choice[2].cost[c];
                if (cost >= least)
                    continue;
                memcpy(axes, try, sizeof try);
                least = cost;
            }
    for (int k = 0; k < 3; k++) {
        axes[k].place = axes[k].first;
        axes[k].advance = axes[k].step;
    }
}

static bool touches(const WorldDef *def, double place, double wall)
{
    return fabs(place - wall) < near * def->spacing;
}

/* Spread the layers along an axis with a free side, from the other side on, so that a point has a particle's
   volume; upwards first. */
static void keep_volume(const WorldDef *def, const BlockGroup *group, FillAxis axes[3])
{
    static const int order[3] = {1, 0, 2};
    const double cell = cell_of(def, axes);
    if (!group->has_block || fabs(cell - 1) < 1e-6 || !(cell > 0.5 && cell < 2))
        return;
    for (int j = 0; j < 3; j++) {
        const int k = order[j];
        const double low = group->low[k], high = group->high[k], wall = wall_low(def, k);
        const double longer = (high - low) / cell;
        const bool at_low = touches(def, low, wall), at_high = touches(def, high, wall + def->box_size[k]);
        if (k >= def->dimensions || def->periodic[k] || (at_low && at_high))
            continue;
        const double from = at_low ? low : at_high ? high - longer : 0.5 * (low + high - longer);
        if (from < wall - slack || from + longer > wall + def->box_size[k] + slack)
            continue;
        axes[k].advance = axes[k].step / cell;
        axes[k].place = from + (axes[k].first - low) / cell;
        return;
    }
}

void fill_lattice(const WorldDef *def, const FillGroups *groups, int fill, FillAxis axes[3])
{
    BlockGroup group;
    double low[3] = {0}, high[3] = {0};
    assert(def->dimensions <= 3);
    group_of(def, groups, fill, &group);
    group_axes(def, &group, axes);
    keep_volume(def, &group, axes);
    fill_bounds(groups->fill[fill], low, high);
    for (int k = 0; k < def->dimensions; k++) {
        axes[k].begin = (long)fmax((double)axes[k].begin, floor((low[k] - axes[k].first) / axes[k].step));
        axes[k].end = (long)fmin((double)axes[k].end, ceil((high[k] - axes[k].first) / axes[k].step) + 1);
    }
}

bool fill_pile(const WorldDef *def, const FillGroups *groups, int fill, const FillAxis axes[3],
               FillPile *pile)
{
    BlockGroup group;
    double worst = 0;
    pile->count = 0;
    if (!groups->pile[groups->group[fill]])
        return false;
    group_of(def, groups, fill, &group);
    for (int k = 0; k < def->dimensions && group.count > 1; k++)
        worst = fmax(worst, misfit(def, &group, k, axes[k].first, axes[k].step));
    if (worst <= on_face)
        return false;
    pile->dimensions = def->dimensions;
    pile->count = group.count;
    memcpy(pile->blocks, group.fills, (size_t)group.count * sizeof *group.fills);
    memcpy(pile->axes, axes, sizeof pile->axes);
    return true;
}

/* The block's part of a layer's cell, 0 to 1. */
static double part_of(const FillPile *pile, const Fill *block, const long index[3])
{
    double part = 1;
    for (int k = 0; k < pile->dimensions; k++) {
        const double step = pile->axes[k].step, middle = pile->axes[k].first + (double)index[k] * step;
        const double low = fmax(block->min[k], middle - 0.5 * step);
        part *= fmax(0, fmin(block->max[k], middle + 0.5 * step) - low) / step;
    }
    return part;
}

/* In [0, 1), evenly spread over any line or plane of points: multiples of the golden ratio and of the roots
   of 3 and 2. Of n points in a plane, n p are below p, within 1.5 (root of the mean square; 100 to 6,000
   points). */
static double turn_of(const long index[3])
{
    const double at = 0.6180339887498949 * (double)index[0] + 0.7320508075688772 * (double)index[1] +
                      0.41421356237309515 * (double)index[2];
    return at - floor(at);
}

const Fill *fill_pile_owner(const FillPile *pile, const long index[3])
{
    const double turn = turn_of(index);
    double all = 0;
    const Fill *owner = NULL;
    for (int i = 0; i < pile->count; i++) {
        const double part = part_of(pile, pile->blocks[i], index);
        if (!owner && turn < all + part && part > on_face)
            owner = pile->blocks[i];
        all += part;
    }
    return all > 1 - on_face ? owner : NULL;
}

static double volume_of_blocks(const WorldDef *def, const BlockGroup *group)
{
    double volume = 0;
    for (int i = 0; i < group->count; i++)
        if (group->fills[i]->kind == FILL_BLOCK)
            volume += fill_volume(group->fills[i], def->dimensions);
    return volume;
}

/* The group with the greatest volume of blocks; without a block, has_block is false. */
static void largest_group(const WorldDef *def, BlockGroup *largest)
{
    double most = 0;
    FillGroups groups;
    BlockGroup group;
    fill_groups(def, &groups);
    largest->count = 0;
    largest->has_block = false;
    for (int fill = 0; fill < groups.count; fill++) {
        if (groups.group[fill] != fill)
            continue;
        group_of(def, &groups, fill, &group);
        const double volume = volume_of_blocks(def, &group);
        if (volume > most) {
            *largest = group;
            most = volume;
        }
    }
}

/* Root of a number near 1, by Newton: the last bit of the C library's root depends on the processor. */
static double root_near_one(double x, int power)
{
    double root = 1;
    for (int i = 0; i < 8; i++)
        root -= power == 2 ? (root - x / root) / 2 : (root - x / (root * root)) / 3;
    return root;
}

/* The spacing at which the lattice chosen for `spacing` has a particle's volume per point. Writes the
   greatest relative difference of a step from the result to *uneven, and the misfit of the group's inner
   faces to *off. Returns 0 if the result gives a different lattice. */
static double fit_at(const WorldDef *def, const BlockGroup *group, double spacing, double *uneven,
                     double *off)
{
    WorldDef at = *def;
    FillAxis axes[3];
    at.spacing = spacing;
    group_axes(&at, group, axes);
    at.spacing *= root_near_one(cell_of(&at, axes), def->dimensions);
    group_axes(&at, group, axes);
    *uneven = *off = 0;
    for (int k = 0; k < def->dimensions; k++) {
        const double misses = misfit(def, group, k, axes[k].first, axes[k].step);
        *uneven = fmax(*uneven, fabs(axes[k].step / at.spacing - 1));
        *off = fmax(*off, misses > on_face ? misses : 0);
    }
    return fabs(cell_of(&at, axes) - 1) < 1e-9 ? at.spacing : 0;
}

double fill_lattice_fit(const WorldDef *def, double *uneven)
{
    BlockGroup group;
    double off;
    *uneven = 0;
    largest_group(def, &group);
    return group.has_block ? fit_at(def, &group, def->spacing, uneven, &off) : def->spacing;
}

double fill_lattice_spacing(const WorldDef *def)
{
    enum { TRIES = 200 };
    BlockGroup group;
    FillAxis axes[3];
    largest_group(def, &group);
    group_axes(def, &group, axes);
    if (!group.has_block || fabs(cell_of(def, axes) - 1) < 1e-6)
        return def->spacing;
    double best = def->spacing, least = INFINITY;
    for (int j = -TRIES; j <= TRIES; j++) {
        double uneven, off;
        const double fit = fit_at(def, &group, def->spacing * (1 + 0.1 * j / TRIES), &uneven, &off);
        const double cost = fabs(fit / def->spacing - 1) + uneven + 0.2 * off;
        if (fit > 0 && cost < least) {
            best = fit;
            least = cost;
        }
    }
    return best;
}

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
typedef struct HeightFormula {
    char text[FORMULA_SIZE];
    Formula formula; /* no steps: the text is no valid formula */
    double x, z, y;
} HeightFormula;

static void height_read(HeightFormula *height, const char *text)
{
    Error error;
    *height = (HeightFormula){.x = NAN};
    memcpy(height->text, text, strlen(text) + 1);
    if (!formula_read(text, "xz", &height->formula, &error))
        height->formula.count = 0;
}

static HeightFormula *height_of(const char text[FORMULA_SIZE])
{
    static _Thread_local HeightFormula kept[FORMULAS_KEPT];
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
    HeightFormula *height = height_of(fill->below);
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
