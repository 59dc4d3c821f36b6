#include "render/views/pbsr/pbsr_private.h"
#include "sim/points/points.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

/* Radius of a torus's tube, as a fraction of the ring's radius. */
static const double TUBE = 1.0 / 3;

/* The field in the layer's own frame, which is the box's frame without a pose. Returns false with the
   reason: a file could not be read, values are NaN, or a formula is wrong. `formula`: of the field. */
static bool rigid_field(const PbsrLayer *said, const double box[3], Formula *formula, LevelField *field,
                        Error *error)
{
    const double low[3] = {-box[0] / 2, 0, -box[2] / 2}, high[3] = {box[0] / 2, box[1], box[2] / 2};
    const double centre[3] = {0, box[1] / 2, 0}, size = said->level;
    if (pbsr_is_of_file(said)) {
        if (!said->data)
            return error_set(error, "%s could not be read", said->file);
        return said->of > PBSR_SLICE_Z
                   ? error_set(error, "of a file a layer is a surface, volume or slice")
                   : level_volume(&said->data->volume, pbsr_interpolation(said), field, error);
    }
    switch (said->of) {
    case PBSR_SPHERE:
        *field = level_sphere(centre, size);
        break;
    case PBSR_TORUS:
        *field = level_torus(centre, size, size * TUBE);
        break;
    case PBSR_GYROID:
        *field = level_gyroid(low, high, size);
        break;
    case PBSR_FORMULA:
        *field = level_formula(formula, low, high);
        return formula_read(said->formula, "xyz", formula, error);
    default:
        *field = level_wave(low, high, size, 0.1 * box[1], 0.5 * fmax(box[0], box[2]));
    }
    return true;
}

/* Converts a row for positions x in the box's frame to the layer's frame: place = turn (x - middle) +
   middle + position. */
static void move_row(const float row[4], const double turn[3][3], const double middle[3],
                     const double position[3], float out[4])
{
    double shift = (double)row[3];
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < 3; i++)
            sum += (double)row[i] * turn[i][k];
        out[k] = (float)sum;
        shift += (double)row[k] * (middle[k] + position[k]) - sum * middle[k];
    }
    out[3] = (float)shift;
}

/* The sight for positions in the layer's frame and for the values of the layer's data. */
static SetSight rigid_sight(const PbsrLayer *said, const LevelField *field, const SetSight *sight)
{
    SetSight own = *sight;
    double turn[3][3], middle[3];
    rigid_rotation(said, turn);
    for (int k = 0; k < 3; k++)
        middle[k] = (field->low[k] + field->high[k]) / 2;
    for (int r = 0; r < 3; r++)
        move_row(sight->row[r], turn, middle, said->position, own.row[r]);
    if (said->data) {
        own.low = said->data->low;
        own.scale = said->data->high > said->data->low ? 1 / (said->data->high - said->data->low) : 1;
    }
    return own;
}

bool rigid_leaves_box(const PbsrLayer *said, const double box[3])
{
    const double *at = said->position;
    const double reach = said->level * (said->of == PBSR_TORUS ? 1 + TUBE : 1);
    const bool ball = said->of == PBSR_SPHERE || said->of == PBSR_TORUS;
    return pbsr_is_rigid(said) &&
           (pbsr_is_of_file(said) || at[0] != 0 || at[1] != 0 || at[2] != 0 || said->angle_deg != 0 ||
            said->motion_count > 0 || (ball && 2 * reach > fmin(box[0], fmin(box[1], box[2]))));
}

bool data_pieces_wanted(const PbsrLayer *said)
{
    return pbsr_is_of_file(said) && said->of >= PBSR_VOLUME && said->of <= PBSR_SLICE_Z;
}

/* Side of the data's block of cells around all values, m. */
static double side_of(const VolumeData *volume, int axis)
{
    return volume->spacing[axis] * volume->size[axis];
}

/* Density of the points of a set, from the layer's opacity. */
static double data_pieces_density(const PbsrLayer *said)
{
    const VolumeData *volume = &said->data->volume;
    const double side = fmin(side_of(volume, 0), fmin(side_of(volume, 1), side_of(volume, 2)));
    return point_density_of_opacity(said->opacity, said->of == PBSR_VOLUME ? side : 1);
}

static void value_place(const VolumeData *volume, const size_t index[3], double place[3])
{
    for (int k = 0; k < 3; k++)
        place[k] = volume->corner[k] + volume->spacing[k] * (double)index[k];
}

static LayerPoint point_at(const double place[3], float value, float inside)
{
    return (LayerPoint){
        .at = {(float)place[0], (float)place[1], (float)place[2]}, .value = value, .inside = inside};
}

/* ---- slices ---- */

/* Adds the two triangles of the square with the first corner `first`, in rows of `width` points. */
static void add_square(LayerPieces *out, size_t first, size_t width)
{
    const uint32_t at = (uint32_t)first, up = (uint32_t)width;
    const uint32_t two[2][3] = {{at, at + 1, at + up}, {at + 1, at + up + 1, at + up}};
    memcpy(out->triangle + out->triangle_count, two, sizeof two);
    out->triangle_count += 2;
}

static bool make_slice(const VolumeData *volume, const LevelField *field, int axis, double level,
                       LayerPieces *out, Error *error)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const size_t width = (size_t)volume->size[u], count = width * (size_t)volume->size[v];
    if (!(level >= field->low[axis] && level <= field->high[axis]))
        return error_set(error, "the slice at %g m is beside the data, which are at %g to %g m", level,
                         field->low[axis], field->high[axis]);
    if (count > UINT32_MAX || !layer_reserve(out, count, 2 * count))
        return error_set(error, "no memory for a slice of %zu values", count);
    for (size_t i = 0; i < count; i++) {
        const size_t column = i % width, row = i / width;
        size_t index[3] = {0};
        double place[3];
        LevelSample sample;
        index[u] = column;
        index[v] = row;
        value_place(volume, index, place);
        place[axis] = level;
        level_at(field, place, &sample);
        out->point[out->point_count++] = point_at(place, sample.value, 1);
        if (column + 1 < width && i + width < count)
            add_square(out, i, width);
    }
    return true;
}

/* ---- the cloud ---- */

/* Linear, from 0 at the level to 1 at the largest value. */
static float density_of(const PbsrLayer *said, float value)
{
    const float level = (float)said->level;
    return (value - level) / (said->data->high - level);
}

static bool make_cloud(const PbsrLayer *said, LayerPieces *out, Error *error)
{
    const VolumeData *volume = &said->data->volume;
    const size_t width = (size_t)volume->size[0], height = (size_t)volume->size[1],
                 all = width * height * (size_t)volume->size[2];
    size_t count = 0;
    for (size_t i = 0; i < all; i++)
        count += volume->value[i] > (float)said->level;
    if (count == 0)
        return error_set(error, "no value is above the level %g: they are %g to %g", said->level,
                         (double)said->data->low, (double)said->data->high);
    if (!layer_reserve(out, count, 0))
        return error_set(error, "no memory for a cloud of %zu cells", count);
    memcpy(out->cell, volume->spacing, sizeof out->cell);
    for (size_t i = 0; i < all; i++) {
        const size_t row = i / width, index[3] = {i % width, row % height, row / height};
        double place[3];
        if (!(volume->value[i] > (float)said->level))
            continue;
        value_place(volume, index, place);
        out->point[out->point_count++] =
            point_at(place, volume->value[i], density_of(said, volume->value[i]));
    }
    return true;
}

/* Makes the pieces from rigid_field's field. A slice has the data's resolution. A cloud's density is
   proportional to the value above the level, 1 at the largest value. Returns false if memory is short, or
   if the result would be empty. */
static bool data_pieces_make(const PbsrLayer *said, const LevelField *field, unsigned number,
                             LayerPieces *out, Error *error)
{
    out->number = number;
    out->point_count = out->triangle_count = 0;
    return said->of == PBSR_VOLUME
               ? make_cloud(said, out, error)
               : make_slice(&said->data->volume, field, said->of - PBSR_SLICE_X, said->level, out, error);
}

/* Largest number of points if there is only one set. */
static const double ONE_MOST = 4.8e7;

/* Number of pixels prefetched at a time; number of points of a set prefetched in advance. */
enum { SPOTS = 64, AHEAD = 12 };

/* The density is the smallest power of this number that a look needs: equal for looks from about the same
   distance, whatever came before, and enough for coming a tenth nearer. */
static const double NEARER = 1.25;

static float depth_of(const SetSight *sight, const double at[3])
{
    const float *row = sight->row[2];
    return row[0] * (float)at[0] + row[1] * (float)at[1] + row[2] * (float)at[2] + row[3];
}

/* The least depth of the field's bounds, m; for a turned layer, of the bounding ball, since the layer may
   keep turning. */
static double nearest_of(const RigidLayer *rigid, bool turned)
{
    const LevelField *field = &rigid->field;
    double middle[3], square = 0, nearest = INFINITY;
    for (int k = 0; k < 3; k++) {
        middle[k] = (field->low[k] + field->high[k]) / 2;
        square += pow(field->high[k] - middle[k], 2);
    }
    for (int corner = 0; corner < 8 && !turned; corner++) {
        const double at[3] = {corner & 1 ? field->high[0] : field->low[0],
                              corner & 2 ? field->high[1] : field->low[1],
                              corner & 4 ? field->high[2] : field->low[2]};
        nearest = fmin(nearest, (double)depth_of(&rigid->sight, at));
    }
    if (turned)
        nearest = (double)depth_of(&rigid->sight, middle) - sqrt(square);
    return fmax(nearest, (double)rigid->sight.near_plane);
}

/* Area of the faces of a field's bounds, m2. */
static double faces_of(const LevelField *field)
{
    double faces = 0;
    for (int k = 0; k < 3; k++)
        faces += 2 * (field->high[k] - field->low[k]) * (field->high[(k + 1) % 3] - field->low[(k + 1) % 3]);
    return faces;
}

static void drop_buffer(RigidLayer *rigid)
{
    if (rigid->buffer)
        glDeleteBuffers(1, &rigid->buffer);
    rigid->buffer = 0;
}

/* Uses the GPU if available for the sampler and field. */
static bool make_points(RigidLayer *rigid, const SurfaceRequest *said, SurfaceResult *result)
{
    SurfaceRequest request = *said;
    const bool by_gpu = rigid->gpu && rigid->polygons.vertex_count == 0 && said->sampler == SURFACE_WALK &&
                        surface_gpu_knows(said->field) && (!said->colour || surface_gpu_knows(said->colour));
    request.device = by_gpu ? &rigid->gpu->device : NULL;
    request.stay = request.device != NULL;
    drop_buffer(rigid);
    bool made = rigid->polygons.vertex_count > 0
                    ? polygons_sample(&rigid->polygons, &request, &rigid->points, result, &rigid->trouble)
                    : surface_sample(&request, &rigid->points, result, &rigid->trouble);
    if (!made && by_gpu) { /* the CPU may manage what is too much for the GPU */
        request.device = NULL;
        request.stay = false;
        made = surface_sample(&request, &rigid->points, result, &rigid->trouble);
    }
    if (!made)
        return false;
    rigid->buffer = request.stay ? surface_gpu_take_points(rigid->gpu) : 0;
    rigid->count = result->points;
    return true;
}

/* Makes `sets` sets (at least one) with the given density. */
static bool make_sets(RigidLayer *rigid, unsigned number, double density, double sets, SurfaceResult *result)
{
    const LevelField *field = &rigid->field;
    const bool costly = rigid->said.of == PBSR_FORMULA && !pbsr_is_of_file(&rigid->said);
    const bool triangles =
        rigid->said.sampler == PBSR_SAMPLER_TRIANGLES || (costly && rigid->said.sampler == PBSR_SAMPLER_AUTO);
    const int most = (int)fmin(sets, rigid->repeat);
    const SurfaceRequest request = {
        .field = field,
        .level = pbsr_is_of_file(&rigid->said) || rigid->said.of == PBSR_FORMULA ? rigid->said.level : 0,
        .sampler = triangles ? SURFACE_TRIANGLES : SURFACE_WALK,
        .density = density,
        .sets = most > 1 ? most : 1,
        .seed = random_mix(random_mix((uint64_t)rigid->seed) + rigid->stream),
        .surface = number,
        .pixel = sqrt(rigid->wanted * (1 + (double)rigid->sight.edges) / rigid->needed), /* where the layer is
                                                                                            nearest */
        .points_most = (size_t)(most > 1 ? rigid->most : fmax(rigid->most, ONE_MOST * rigid->share))};
    rigid->points.count = 0;
    rigid->sets = 0;
    rigid->made++;
    rigid->note[0] = '\0';
    if (!make_points(rigid, &request, result))
        return false;
    memcpy(rigid->note, result->note, sizeof rigid->note);
    rigid->density = result->reached ? density : fmin(result->density, density);
    rigid->sets = request.sets;
    return true;
}

/* Finds how many sets fit, from the area of a few points: the area inside the bounds may differ much from
   the bounds' faces. */
static bool find_sets(RigidLayer *rigid, unsigned number, double *sets)
{
    static const double FEW = 2e4, SPARE = 0.95; /* the area has an error of some hundredths */
    SurfaceResult result;
    if (!make_sets(rigid, number, fmin(FEW / faces_of(&rigid->field), rigid->asked), 1, &result))
        return false;
    *sets = SPARE * rigid->most / (rigid->asked * result.area);
    return true;
}

/* FOLDS: a gyroid may have several times the area of its bounds' faces. */
static bool sample_surface(RigidLayer *rigid, unsigned number, int most)
{
    static const double FOLDS = 8;
    SurfaceResult result;
    double sets = rigid->most / (rigid->asked * faces_of(&rigid->field) * FOLDS);
    rigid->few = false;
    if (sets < most && !find_sets(rigid, number, &sets))
        return false;
    rigid->few = most < rigid->repeat && sets > most;
    return make_sets(rigid, number, rigid->asked, fmin(sets, most), &result);
}

/* Compares everything except pose and look. */
static bool same_surface(const PbsrLayer *a, const PbsrLayer *b)
{
    return a->of == b->of && a->level == b->level && a->sampler == b->sampler && a->data == b->data &&
           a->interpolation == b->interpolation && a->formula == b->formula &&
           pbsr_is_of_file(a) == pbsr_is_of_file(b);
}

static bool same(const RigidLayer *rigid, const PbsrLayer *said, const PbsrDef *def, const double box[3])
{
    return same_surface(&rigid->said, said) && rigid->seed == def->seed && rigid->repeat == def->repeat &&
           rigid->most == def->points && rigid->box[0] == box[0] && rigid->box[1] == box[1] &&
           rigid->box[2] == box[2];
}

/* Makes the field; for slices and clouds also the pieces. */
static bool begin_layer(RigidLayer *rigid, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                        unsigned number)
{
    rigid_layer_free(rigid);
    rigid->said = *said;
    rigid->stream = number;
    rigid->seed = def->seed;
    rigid->repeat = def->repeat;
    rigid->most = def->points;
    rigid->share = 1;
    memcpy(rigid->box, box, sizeof rigid->box);
    rigid->begun = rigid_field(said, box, &rigid->formula, &rigid->field, &rigid->trouble) &&
                   (!data_pieces_wanted(said) ||
                    data_pieces_make(said, &rigid->field, number, &rigid->pieces, &rigid->trouble));
    return rigid->begun;
}

static bool see_pieces(RigidLayer *rigid, const PbsrLayer *said)
{
    set_sight_find_eye(&rigid->sight);
    rigid->pieces.density = data_pieces_density(said);
    return layer_make_shares(&rigid->pieces, &rigid->sight) ||
           error_set(&rigid->trouble, "no memory for the points of a layer");
}

static double reserve_of(double needed)
{
    return pow(NEARER, ceil(log(needed) / log(NEARER) + 1e-9)); /* rounding must not give less than needed */
}

bool rigid_layer_is_unfinished(const RigidLayer *rigid)
{
    return rigid->sets > 0 &&
           (rigid->few || (rigid->sets < rigid->repeat && rigid->needed < rigid->asked / 2));
}

/* True if new points are needed. Without `moving`: if other looks would have left other points. With
   `moving`: if points are too few, or at rest if more sets are possible. */
static bool falls_short(const RigidLayer *rigid, bool changes)
{
    if (rigid->moving == 0)
        return rigid->few || rigid->asked != reserve_of(rigid->needed);
    return rigid->needed > rigid->asked || (!changes && rigid_layer_is_unfinished(rigid));
}

bool rigid_layer_make_points(RigidLayer *rigid, const PbsrLayer *said, bool turned, unsigned number)
{
    const double nearest = nearest_of(rigid, turned), before = rigid->needed;
    set_sight_find_eye(&rigid->sight);
    rigid->needed = (1 + (double)rigid->sight.edges) *
                    point_density_of_opacity(said->opacity, (double)rigid->sight.pixel * nearest * nearest);
    rigid->wanted = point_density_of_opacity(said->opacity, 1);
    if (!(rigid->wanted > 0))
        return true;
    const bool hurries = rigid->moving > 0 && rigid->needed != before;
    if (!falls_short(rigid, hurries))
        return rigid->sets > 0;
    rigid->asked = reserve_of(rigid->needed);
    return sample_surface(rigid, number,
                          hurries && rigid->moving < rigid->repeat ? rigid->moving : rigid->repeat);
}

bool rigid_layer_update(RigidLayer *rigid, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                        unsigned number, const SetSight *sight)
{
    if (!pbsr_is_rigid(said)) {
        rigid_layer_free(rigid);
        return true;
    }
    if (!(rigid->followed && same(rigid, said, def, box)))
        begin_layer(rigid, said, def, box, number);
    rigid->followed = true;
    if (!rigid->begun)
        return false;
    rigid->sight = rigid_sight(said, &rigid->field, sight);
    return data_pieces_wanted(said)
               ? see_pieces(rigid, said)
               : rigid_layer_make_points(rigid, said, said->motion_count > 0 || said->angle_deg != 0, number);
}

void rigid_layer_of_polygons(RigidLayer *rigid, Polygons *polygons, const PbsrDef *def, unsigned stream,
                             double share)
{
    rigid_layer_free(rigid);
    rigid->polygons = *polygons;
    *polygons = (Polygons){0};
    polygons_bounds(&rigid->polygons, rigid->field.low, rigid->field.high);
    rigid->stream = stream;
    rigid->seed = def->seed;
    rigid->repeat = def->repeat;
    rigid->most = def->points * share;
    rigid->share = share;
    rigid->begun = true;
}

double rigid_layer_fraction(const RigidLayer *rigid)
{
    return rigid->sets > 0 && rigid->needed > rigid->density ? rigid->density / rigid->needed : 1;
}

/* A fixed number per point, so that points do not flicker. */
static float chance_of(size_t point)
{
    return (float)(random_mix(point + 1) >> 40) * 0x1p-24F;
}

static void turn_normal(const float turn[3][3], float normal[3])
{
    const float n[3] = {normal[0], normal[1], normal[2]};
    for (int i = 0; i < 3; i++)
        normal[i] = turn[i][0] * n[0] + turn[i][1] * n[1] + turn[i][2] * n[2];
}

void rigid_layer_set_colors(RigidLayer *rigid, const PbsrLayer *said, const FluidLayers *layers)
{
    double turn[3][3];
    rigid->paint = pbsr_takes_fluid_colors(said) && layers->color ? layers : NULL;
    rigid_rotation(said, turn);
    for (int i = 0; i < 3; i++) {
        rigid->to_box[i][3] = said->position[i] + (rigid->field.low[i] + rigid->field.high[i]) / 2;
        for (int k = 0; k < 3; k++) {
            rigid->to_box[i][k] = turn[i][k];
            rigid->to_box[i][3] -= turn[i][k] * (rigid->field.low[k] + rigid->field.high[k]) / 2;
        }
    }
}

/* Colours a point; returns the number of the point's look. */
static unsigned paint(const RigidLayer *rigid, LayerPoint *point, unsigned number)
{
    const float *at = point->at;
    double place[3];
    for (int i = 0; i < 3; i++) {
        const double *row = rigid->to_box[i];
        place[i] = row[0] * (double)at[0] + row[1] * (double)at[1] + row[2] * (double)at[2] + row[3];
    }
    if (fluid_layers_color(rigid->paint, place, &point->value))
        return number;
    const float n[3] = {point->normal[0], point->normal[1], point->normal[2]};
    for (int i = 0; i < 3; i++)
        point->normal[i] = (float)rigid->to_box[i][0] * n[0] + (float)rigid->to_box[i][1] * n[1] +
                           (float)rigid->to_box[i][2] * n[2];
    return OUTSIDE_NUMBER;
}

static uint32_t word_of(const RigidLayer *rigid, const SurfacePoint *from)
{
    const float *at = from->position;
    LayerPoint point = {.at = {at[0], at[1], at[2]}, .value = from->value};
    if (rigid->polygons.vertex_count == 0 && !rigid->paint)
        return set_word_of_point(from, &rigid->sight);
    surface_normal_unpack(from->normal, point.normal);
    if (rigid->polygons.vertex_count > 0)
        turn_normal(rigid->turn, point.normal);
    return set_word(&point, &rigid->sight,
                    rigid->paint ? paint(rigid, &point, from->surface) : from->surface);
}

float rigid_layer_boost(const RigidLayer *rigid, const SurfacePoint *from)
{
    float normal[3];
    if (!(rigid->sight.edges > 0))
        return 1;
    surface_normal_unpack(from->normal, normal);
    return set_sight_boost(&rigid->sight, from->position, normal);
}

/* True if the point is needed at its depth. */
static bool point_stays(const RigidLayer *rigid, const SurfacePoint *from, size_t i)
{
    const float *at = from->position;
    const float *row = rigid->sight.row[2];
    const float have = (float)rigid->density * rigid->sight.pixel;
    const float w = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
    return !(chance_of(i) * have * w * w > (float)rigid->wanted * rigid_layer_boost(rigid, from));
}

typedef struct PointSpots {
    const SurfacePoint *point[SPOTS];
    SetSpot spot[SPOTS];
    int count;
} PointSpots;

static void put_spots(const RigidLayer *rigid, const PointSpots *spots, const SetImage *image)
{
    for (int i = 0; i < spots->count; i++)
        if (set_image_open(image, &spots->spot[i]))
            set_image_put(image, &spots->spot[i], word_of(rigid, spots->point[i]));
}

static void project_points(const RigidLayer *rigid, uint64_t set, const SetImage *image)
{
    const size_t sets = (size_t)rigid->sets, count = rigid->points.count;
    PointSpots spots = {.count = 0};
    for (size_t i = sets > 0 ? set % sets : 0; sets > 0 && i < count; i += sets) {
        const SurfacePoint *from = &rigid->points.point[i];
        SetSpot *spot = &spots.spot[spots.count];
        __builtin_prefetch(&rigid->points.point[i + AHEAD * sets < count ? i + AHEAD * sets : i]);
        if (!point_stays(rigid, from, i) || !set_image_spot(image, &rigid->sight, from->position, spot))
            continue;
        __builtin_prefetch(&image->depth[spot->pixel], 1);
        __builtin_prefetch(&image->word[spot->pixel], 1);
        spots.point[spots.count++] = from;
        if (spots.count < SPOTS)
            continue;
        put_spots(rigid, &spots, image);
        spots.count = 0;
    }
    put_spots(rigid, &spots, image);
}

void rigid_layer_project(const RigidLayer *rigid, uint64_t seed, uint64_t set, const SetImage *image)
{
    if (rigid->pieces.point_count > 0)
        layer_project(&rigid->pieces, seed, set, &rigid->sight, image);
    project_points(rigid, set, image);
}

void rigid_layer_free(RigidLayer *rigid)
{
    const uint64_t made = rigid->made + (rigid->points.count > 0 || rigid->buffer);
    surface_points_free(&rigid->points);
    drop_buffer(rigid);
    layer_free(&rigid->pieces);
    polygons_free(&rigid->polygons);
    *rigid = (RigidLayer){.gpu = rigid->gpu, .moving = rigid->moving, .made = made};
}
