#include "render/views/pbsr/pbsr_private.h"
#include "sim/base/base.h"
#include "sim/points/points.h"

#include <math.h>
#include <string.h>

/* 24 bytes each. */
static const size_t POINTS_MOST = 12000000;

enum { PART = 4096 };

bool fluid_walk_wanted(const PbsrLayer *said)
{
    return said->sampler == PBSR_SAMPLER_WALK && !pbsr_is_rigid(said) &&
           (said->of == PBSR_SURFACE || said->of >= PBSR_SCALARS);
}

bool fluid_walk_by_grid(const PbsrLayer *said)
{
    return fluid_walk_wanted(said) && said->of == PBSR_SURFACE && said->interpolation != PBSR_BY_ITSELF;
}

static bool take_particles(FluidWalk *walk, const PbsrLayer *said, FluidLayers *layers,
                           const ParticleBuffers *particles)
{
    Error error;
    FieldParticles some;
    fluid_field_particles(&layers->fluid, particles,
                          said->of >= PBSR_SCALARS ? (Scalar)(said->of - PBSR_SCALARS) : SCALAR_FLUID, &some);
    walk->sph = sph_field_create(&some, &error);
    return walk->sph != NULL;
}

void fluid_walk_begin(FluidWalk *walk, const PbsrLayer *said, FluidLayers *layers,
                      const ParticleBuffers *particles, double flat, bool by_gpu)
{
    fluid_walk_free(walk);
    if (!fluid_walk_wanted(said))
        return;
    walk->why = by_gpu     ? "the walk on the fluid is the CPU's, with view.pbsr.method: cpu"
                : flat > 0 ? "a walk on the fluid needs three dimensions"
                           : NULL;
    if (walk->why || layers->fluid.count == 0)
        return;
    if (fluid_walk_by_grid(said)) {
        walk->grid = volume_of_grid(&layers->fluid.grid, layers->fluid.field);
        walk->made =
            level_volume(&walk->grid, pbsr_interpolation(said), &walk->rigid.field, &walk->rigid.trouble);
        walk->why = walk->made ? NULL : walk->rigid.trouble.message;
        return;
    }
    if (take_particles(walk, said, layers, particles))
        walk->rigid.field = said->of == PBSR_SURFACE ? level_sph(walk->sph) : level_sph_inside(walk->sph);
    else
        walk->why = "no memory for a walk";
    walk->made = walk->sph != NULL;
}

/* ---- visible triangles ---- */

static bool is_seen(const LayerPieces *layer, size_t triangle)
{
    return layer->share[triangle].expected > 0;
}

/* Copies the visible triangles, and all vertices: unused vertices do no harm. */
static bool take_near(FluidWalk *walk, const LayerPieces *layer)
{
    Error error;
    size_t seen = 0;
    for (size_t i = 0; i < layer->triangle_count; i++)
        seen += is_seen(layer, i);
    if (!polygons_reserve(&walk->near, layer->point_count, seen, &error))
        return false;
    for (size_t i = 0; i < layer->point_count; i++) {
        memcpy(walk->near.place[i], layer->point[i].at, sizeof walk->near.place[i]);
        memset(walk->near.normal[i], 0, sizeof walk->near.normal[i]);
    }
    seen = 0;
    for (size_t i = 0; i < layer->triangle_count; i++)
        if (is_seen(layer, i))
            memcpy(walk->near.corner[seen++], layer->triangle[i], sizeof *walk->near.corner);
    return true;
}

void fluid_walk_select(FluidWalk *walk, const PbsrLayer *said, const LayerPieces *layer,
                       const SetSight *sight)
{
    RigidLayer *rigid = &walk->rigid;
    double nearest = HUGE_VAL;
    walk->walks = walk->made && layer->triangle_count > 0;
    rigid->sets = 0;
    rigid->points.count = 0;
    if (!walk->walks)
        return;
    if (!take_near(walk, layer)) {
        walk->why = "no memory for a walk";
        walk->walks = false;
        return;
    }
    for (size_t i = 0; i < layer->triangle_count; i++)
        if (is_seen(layer, i))
            nearest = fmin(nearest, (double)layer->share[i].nearest);
    nearest = isfinite(nearest) ? fmax(nearest, (double)sight->near_plane) : 1;
    rigid->sight = *sight;
    rigid->wanted = point_density_of_opacity(said->opacity, 1);
    rigid->needed = (1 + (double)sight->edges) *
                    point_density_of_opacity(said->opacity, (double)sight->pixel * nearest * nearest);
    rigid->density = rigid->needed;
}

/* ---- points of sets ---- */

typedef struct ColorJob {
    const FluidLayers *layers;
    SurfacePoint *point;
} ColorJob;

static void color_range(void *context, size_t begin, size_t end)
{
    const ColorJob *coloring = context;
    for (size_t i = begin; i < end; i++) {
        const float *at = coloring->point[i].position;
        coloring->point[i].value =
            fluid_layers_value(coloring->layers, coloring->layers->color,
                               (double[]){(double)at[0], (double)at[1], (double)at[2]});
    }
}

static void color_points(SurfacePoints *points, const FluidLayers *layers)
{
    ColorJob coloring = {layers, points->point};
    if (layers->color)
        parallel_ranges(parallel_processors(), points->count, PART, color_range, &coloring);
}

void fluid_walk_sample(FluidWalk *walk, const PbsrLayer *said, const FluidLayers *layers, unsigned number,
                       int seed, int first, int count)
{
    RigidLayer *rigid = &walk->rigid;
    SurfaceResult result;
    if (!walk->walks || !(rigid->wanted > 0) || walk->near.triangle_count == 0)
        return;
    const SurfaceRequest request = {
        .field = &rigid->field,
        .level = said->level,
        .density = rigid->needed,
        .sets = count,
        .seed = random_mix(random_mix(random_mix((uint64_t)seed) + number) + (uint64_t)first),
        .surface = number,
        .pixel = sqrt(rigid->wanted * (1 + (double)rigid->sight.edges) / rigid->needed),
        .points_most = POINTS_MOST};
    rigid->points.count = 0;
    walk->walks = near_walk(&request, &walk->near, &rigid->points, &result, &rigid->trouble);
    rigid->sets = walk->walks ? count : 0;
    if (!walk->walks) {
        walk->why = rigid->trouble.message;
        return;
    }
    rigid->density = result.density;
    memcpy(rigid->note, result.note, sizeof rigid->note);
    rigid->count = rigid->points.count;
    color_points(&rigid->points, layers);
}

void fluid_walk_free(FluidWalk *walk)
{
    sph_field_destroy(walk->sph);
    polygons_free(&walk->near);
    rigid_layer_free(&walk->rigid);
    *walk = (FluidWalk){.walks = false};
}
