#include "render/pbsr/still_layers.h"

#include "render/pbsr/data_pieces.h"
#include "render/pbsr/opacity.h"
#include "render/pbsr/random.h"
#include "render/pbsr/still_field.h"
#include "sim/surface/sampling.h"

#include <epoxy/gl.h>
#include <string.h>

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
static double nearest_of(const StillLayer *still, bool turned)
{
    const LevelField *field = &still->field;
    double middle[3], square = 0, nearest = INFINITY;
    for (int k = 0; k < 3; k++) {
        middle[k] = (field->low[k] + field->high[k]) / 2;
        square += pow(field->high[k] - middle[k], 2);
    }
    for (int corner = 0; corner < 8 && !turned; corner++) {
        const double at[3] = {corner & 1 ? field->high[0] : field->low[0],
                              corner & 2 ? field->high[1] : field->low[1],
                              corner & 4 ? field->high[2] : field->low[2]};
        nearest = fmin(nearest, (double)depth_of(&still->sight, at));
    }
    if (turned)
        nearest = (double)depth_of(&still->sight, middle) - sqrt(square);
    return fmax(nearest, (double)still->sight.near_plane);
}

/* Area of the faces of a field's bounds, m2. */
static double faces_of(const LevelField *field)
{
    double faces = 0;
    for (int k = 0; k < 3; k++)
        faces += 2 * (field->high[k] - field->low[k]) * (field->high[(k + 1) % 3] - field->low[(k + 1) % 3]);
    return faces;
}

static void drop_buffer(StillLayer *still)
{
    if (still->buffer)
        glDeleteBuffers(1, &still->buffer);
    still->buffer = 0;
}

/* Uses the GPU if available for the sampler and field. */
static bool make(StillLayer *still, const SurfaceRequest *said, SurfaceResult *result)
{
    SurfaceRequest request = *said;
    const bool by_gpu = still->gpu && still->polygons.vertex_count == 0 && said->sampler == SURFACE_WALK &&
                        surface_gpu_knows(said->field) && (!said->colour || surface_gpu_knows(said->colour));
    request.device = by_gpu ? &still->gpu->device : NULL;
    request.stay = request.device != NULL;
    drop_buffer(still);
    bool made = still->polygons.vertex_count > 0
                    ? polygons_sample(&still->polygons, &request, &still->points, result, &still->trouble)
                    : surface_sample(&request, &still->points, result, &still->trouble);
    if (!made && by_gpu) { /* the CPU may manage what is too much for the GPU */
        request.device = NULL;
        request.stay = false;
        made = surface_sample(&request, &still->points, result, &still->trouble);
    }
    if (!made)
        return false;
    still->buffer = request.stay ? surface_gpu_take_points(still->gpu) : 0;
    still->count = result->points;
    return true;
}

/* Makes `sets` sets (at least one) with the given density. */
static bool make_sets(StillLayer *still, unsigned number, double density, double sets, SurfaceResult *result)
{
    const LevelField *field = &still->field;
    const bool triangles = still->said.sampler == PBSR_SAMPLER_TRIANGLES;
    const int most = (int)fmin(sets, still->repeat);
    const SurfaceRequest request = {
        .field = field,
        .level = pbsr_of_file(&still->said) ? still->said.level : 0,
        .sampler = triangles ? SURFACE_TRIANGLES : SURFACE_WALK,
        .density = density,
        .sets = most > 1 ? most : 1,
        .seed = random_mix(random_mix((uint64_t)still->seed) + still->stream),
        .surface = number,
        .pixel = sqrt(still->wanted * (1 + (double)still->sight.edges) / still->needed), /* where the layer is
                                                                                            nearest */
        .points_most = (size_t)(most > 1 ? still->most : fmax(still->most, ONE_MOST * still->share))};
    still->points.count = 0;
    still->sets = 0;
    still->made++;
    still->note[0] = '\0';
    if (!make(still, &request, result))
        return false;
    memcpy(still->note, result->note, sizeof still->note);
    still->density = result->reached ? density : fmin(result->density, density);
    still->sets = request.sets;
    return true;
}

/* Finds how many sets fit, from the area of a few points: the area inside the bounds may differ much from
   the bounds' faces. */
static bool find_sets(StillLayer *still, unsigned number, double *sets)
{
    static const double FEW = 2e4, SPARE = 0.95; /* the area has an error of some hundredths */
    SurfaceResult result;
    if (!make_sets(still, number, fmin(FEW / faces_of(&still->field), still->asked), 1, &result))
        return false;
    *sets = SPARE * still->most / (still->asked * result.area);
    return true;
}

/* FOLDS: a gyroid may have several times the area of its bounds' faces. */
static bool sample(StillLayer *still, unsigned number, int most)
{
    static const double FOLDS = 8;
    SurfaceResult result;
    double sets = still->most / (still->asked * faces_of(&still->field) * FOLDS);
    still->few = false;
    if (sets < most && !find_sets(still, number, &sets))
        return false;
    still->few = most < still->repeat && sets > most;
    return make_sets(still, number, still->asked, fmin(sets, most), &result);
}

/* Compares everything except pose and look. */
static bool same_surface(const PbsrLayer *a, const PbsrLayer *b)
{
    return a->of == b->of && a->level == b->level && a->sampler == b->sampler && a->data == b->data &&
           a->interpolation == b->interpolation && pbsr_of_file(a) == pbsr_of_file(b);
}

static bool same(const StillLayer *still, const PbsrLayer *said, const PbsrDef *def, const double box[3])
{
    return same_surface(&still->said, said) && still->seed == def->seed && still->repeat == def->repeat &&
           still->most == def->points && still->box[0] == box[0] && still->box[1] == box[1] &&
           still->box[2] == box[2];
}

/* Makes the field; for slices and clouds also the pieces. */
static bool begin(StillLayer *still, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                  unsigned number)
{
    still_layer_free(still);
    still->said = *said;
    still->stream = number;
    still->seed = def->seed;
    still->repeat = def->repeat;
    still->most = def->points;
    still->share = 1;
    memcpy(still->box, box, sizeof still->box);
    still->begun = still_field(said, box, &still->field, &still->trouble) &&
                   (!data_pieces_are(said) ||
                    data_pieces_make(said, &still->field, number, &still->pieces, &still->trouble));
    return still->begun;
}

static bool see_pieces(StillLayer *still, const PbsrLayer *said)
{
    set_sight_find_eye(&still->sight);
    still->pieces.density = data_pieces_density(said);
    return layer_share(&still->pieces, &still->sight) ||
           error_set(&still->trouble, "no memory for the points of a layer");
}

static double reserve_of(double needed)
{
    return pow(NEARER, ceil(log(needed) / log(NEARER) + 1e-9)); /* rounding must not give less than needed */
}

bool still_layer_waits(const StillLayer *still)
{
    return still->sets > 0 &&
           (still->few || (still->sets < still->repeat && still->needed < still->asked / 2));
}

/* True if new points are needed. Without `moving`: if other looks would have left other points. With
   `moving`: if points are too few, or at rest if more sets are possible. */
static bool falls_short(const StillLayer *still, bool changes)
{
    if (still->moving == 0)
        return still->few || still->asked != reserve_of(still->needed);
    return still->needed > still->asked || (!changes && still_layer_waits(still));
}

bool still_layer_see(StillLayer *still, const PbsrLayer *said, bool turned, unsigned number)
{
    const double nearest = nearest_of(still, turned), before = still->needed;
    set_sight_find_eye(&still->sight);
    still->needed = (1 + (double)still->sight.edges) *
                    point_density_of_opacity(said->opacity, (double)still->sight.pixel * nearest * nearest);
    still->wanted = point_density_of_opacity(said->opacity, 1);
    if (!(still->wanted > 0))
        return true;
    const bool hurries = still->moving > 0 && still->needed != before;
    if (!falls_short(still, hurries))
        return still->sets > 0;
    still->asked = reserve_of(still->needed);
    return sample(still, number, hurries && still->moving < still->repeat ? still->moving : still->repeat);
}

bool still_layer_follow(StillLayer *still, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                        unsigned number, const SetSight *sight)
{
    if (!pbsr_still(said)) {
        still_layer_free(still);
        return true;
    }
    if (!(still->followed && same(still, said, def, box)))
        begin(still, said, def, box, number);
    still->followed = true;
    if (!still->begun)
        return false;
    still->sight = still_sight(said, &still->field, sight);
    return data_pieces_are(said) ? see_pieces(still, said)
                                 : still_layer_see(still, said, said->angle_deg != 0, number);
}

void still_layer_of_polygons(StillLayer *still, Polygons *polygons, const PbsrDef *def, unsigned stream,
                             double share)
{
    still_layer_free(still);
    still->polygons = *polygons;
    *polygons = (Polygons){0};
    polygons_bounds(&still->polygons, still->field.low, still->field.high);
    still->stream = stream;
    still->seed = def->seed;
    still->repeat = def->repeat;
    still->most = def->points * share;
    still->share = share;
    still->begun = true;
}

double still_layer_part(const StillLayer *still)
{
    return still->sets > 0 && still->needed > still->density ? still->density / still->needed : 1;
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

void still_layer_paint(StillLayer *still, const PbsrLayer *said, const FluidLayers *layers)
{
    double turn[3][3];
    still->paint = pbsr_painted(said) && layers->color ? layers : NULL;
    still_turn(said, turn);
    for (int i = 0; i < 3; i++) {
        still->to_box[i][3] = said->position[i] + (still->field.low[i] + still->field.high[i]) / 2;
        for (int k = 0; k < 3; k++) {
            still->to_box[i][k] = turn[i][k];
            still->to_box[i][3] -= turn[i][k] * (still->field.low[k] + still->field.high[k]) / 2;
        }
    }
}

/* Colours a point; returns the number of the point's look. */
static unsigned paint(const StillLayer *still, LayerPoint *point, unsigned number)
{
    const float *at = point->at;
    double place[3];
    for (int i = 0; i < 3; i++) {
        const double *row = still->to_box[i];
        place[i] = row[0] * (double)at[0] + row[1] * (double)at[1] + row[2] * (double)at[2] + row[3];
    }
    if (fluid_layers_color(still->paint, place, &point->value))
        return number;
    const float n[3] = {point->normal[0], point->normal[1], point->normal[2]};
    for (int i = 0; i < 3; i++)
        point->normal[i] = (float)still->to_box[i][0] * n[0] + (float)still->to_box[i][1] * n[1] +
                           (float)still->to_box[i][2] * n[2];
    return OUTSIDE_NUMBER;
}

static uint32_t word_of(const StillLayer *still, const SurfacePoint *from)
{
    const float *at = from->position;
    LayerPoint point = {.at = {at[0], at[1], at[2]}, .value = from->value};
    if (still->polygons.vertex_count == 0 && !still->paint)
        return set_word_of_point(from, &still->sight);
    surface_normal_unpack(from->normal, point.normal);
    if (still->polygons.vertex_count > 0)
        turn_normal(still->turn, point.normal);
    return set_word(&point, &still->sight,
                    still->paint ? paint(still, &point, from->surface) : from->surface);
}

float still_layer_boost(const StillLayer *still, const SurfacePoint *from)
{
    float normal[3];
    if (!(still->sight.edges > 0))
        return 1;
    surface_normal_unpack(from->normal, normal);
    return set_sight_boost(&still->sight, from->position, normal);
}

/* True if the point is needed at its depth. */
static bool stays(const StillLayer *still, const SurfacePoint *from, size_t i)
{
    const float *at = from->position;
    const float *row = still->sight.row[2];
    const float have = (float)still->density * still->sight.pixel;
    const float w = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
    return !(chance_of(i) * have * w * w > (float)still->wanted * still_layer_boost(still, from));
}

typedef struct PointSpots {
    const SurfacePoint *point[SPOTS];
    SetSpot spot[SPOTS];
    int count;
} PointSpots;

static void put_spots(const StillLayer *still, const PointSpots *spots, const SetImage *image)
{
    for (int i = 0; i < spots->count; i++)
        if (set_image_open(image, &spots->spot[i]))
            set_image_put(image, &spots->spot[i], word_of(still, spots->point[i]));
}

static void project_points(const StillLayer *still, uint64_t set, const SetImage *image)
{
    const size_t sets = (size_t)still->sets, count = still->points.count;
    PointSpots spots = {.count = 0};
    for (size_t i = sets > 0 ? set % sets : 0; sets > 0 && i < count; i += sets) {
        const SurfacePoint *from = &still->points.point[i];
        SetSpot *spot = &spots.spot[spots.count];
        __builtin_prefetch(&still->points.point[i + AHEAD * sets < count ? i + AHEAD * sets : i]);
        if (!stays(still, from, i) || !set_image_spot(image, &still->sight, from->position, spot))
            continue;
        __builtin_prefetch(&image->depth[spot->pixel], 1);
        __builtin_prefetch(&image->word[spot->pixel], 1);
        spots.point[spots.count++] = from;
        if (spots.count < SPOTS)
            continue;
        put_spots(still, &spots, image);
        spots.count = 0;
    }
    put_spots(still, &spots, image);
}

void still_layer_project(const StillLayer *still, uint64_t seed, uint64_t set, const SetImage *image)
{
    if (still->pieces.point_count > 0)
        layer_project(&still->pieces, seed, set, &still->sight, image);
    project_points(still, set, image);
}

void still_layer_free(StillLayer *still)
{
    const uint64_t made = still->made + (still->points.count > 0 || still->buffer);
    surface_points_free(&still->points);
    drop_buffer(still);
    layer_free(&still->pieces);
    polygons_free(&still->polygons);
    *still = (StillLayer){.gpu = still->gpu, .moving = still->moving, .made = made};
}
