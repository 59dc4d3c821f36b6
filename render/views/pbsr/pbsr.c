#include "render/views/pbsr/pbsr.h"

#include "render/frame/passes.h"
#include "render/particles/particles.h"
#include "render/views/pbsr/pbsr_private.h"
#include "sim/base/base.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Fixed number: timings from a GPU come too late for a budget. */
enum { GPU_SETS = 8 };

/* Number of sets of rigid layers while looks change, if the def gives none. */
enum { FEW_SETS = 8 };

/* Inputs of the layers: layers stay valid while these are equal. */
typedef struct LayersFrom {
    PbsrDef def;
    uint64_t step;
    double time;
    size_t count;
    unsigned buffer;
    size_t offset;
    Scalar color;
    double box_size[3], spacing, support;
    WorldDef world; /* a new scene may have equal count, buffer and time */
} LayersFrom;

/* Inputs of a picture: while equal, further sets are added to the mean. */
typedef struct PictureFrom {
    LayersFrom layers;
    ViewDef def;
    Camera camera;
    float box_to_world[16];
    double range[2];
    unsigned target;
    bool plain, split, coarse;
} PictureFrom;

typedef struct PbsrView {
    FluidLayers layers;
    FluidWalk steps[PBSR_LAYERS_MAX]; /* used by layers with a walk on the fluid */
    RigidLayer rigid[PBSR_LAYERS_MAX];
    SolidLayers solids;
    Average average;
    Projector project; /* zero if the CPU projects */
    GpuFluid fluid;    /* likewise */
    SurfaceGpu walks;  /* zero if the CPU projects; makes the points of rigid layers */
    ShadowCaster casting;
    LayersFrom made;
    PictureFrom drawn;
    bool valid;     /* `made` and `drawn` are of the last picture */
    int wanted;     /* sets of a picture at rest */
    int there;      /* sets for which rigid layers have points */
    int added;      /* sets of the last picture whose points were not counted */
    bool uncounted; /* counting points failed: memory was short */
    char lack[1400], note[1500];
    size_t lacked; /* length of `lack` */
    Error trouble;
} PbsrView;

static void destroy(void *state)
{
    PbsrView *view = state;
    fluid_layers_free(&view->layers);
    for (int i = 0; i < PBSR_LAYERS_MAX; i++) {
        fluid_walk_free(&view->steps[i]);
        rigid_layer_free(&view->rigid[i]);
    }
    solid_layers_free(&view->solids);
    average_destroy(&view->average);
    if (view->project.program)
        surface_gpu_destroy(&view->walks);
    projector_destroy(&view->project);
    gpu_fluid_destroy(&view->fluid);
    shadow_caster_destroy(&view->casting);
    free(view);
}

static bool check_motions(const PbsrLayer said[], int count, Error *error)
{
    for (int i = 0; i < count; i++)
        for (int m = 0; m < said[i].motion_count; m++) {
            const Motion *motion = &said[i].motions[m];
            if (motion->axis[0] == 0 && motion->axis[1] == 0 && motion->axis[2] == 0)
                return error_set(error,
                                 "motion[%d].%s.axis of layer %d is [0, 0, 0]; it must have a direction", m,
                                 motion_name(motion->kind), i + 1);
        }
    return true;
}

/* The level of a formula's surface is a length. */
static bool check(const Subject *subject, const char **key, Error *error)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers(pbsr_def(subject->def), said);
    *key = "view.pbsr.layers";
    for (int i = 0; i < count; i++) {
        Formula formula;
        if (said[i].of == PBSR_FORMULA && !pbsr_is_of_file(&said[i]) &&
            !(formula_given(said[i].formula)
                  ? formula_read(said[i].formula, "xyz", &formula, error)
                  : error_set(error, "layer %d of a formula has none; give it a `formula` of x, y and z",
                              i + 1)))
            return false;
        if (!pbsr_is_of_file(&said[i]) && said[i].of >= PBSR_SPHERE && said[i].of <= PBSR_GYROID &&
            !(said[i].level > 0))
            return error_set(
                error, "a layer that is a sphere, a torus or a gyroid has a level above 0: a length in m");
    }
    if (!check_motions(said, count, error))
        return false;
    const int solids = solid_layers_number(pbsr_def(subject->def));
    if (solids >= 0 && !pbsr_has_color(&said[solids]) &&
        solid_layers_colors(subject->world) > SOLID_COLORS_MAX)
        return error_set(error,
                         "the solids have %d colours, and a layer of solids shows %d: give the layer a color",
                         solid_layers_colors(subject->world), SOLID_COLORS_MAX);
    return true;
}

static bool projects_on_cpu(const PbsrDef *def)
{
    return def->method == PBSR_CPU || (def->method == PBSR_AUTO && gl_renderer_is_software());
}

/* The GPU that projects also makes the fluid's layers and the kept points. */
static bool create_gpu(PbsrView *view, Error *error)
{
    if (!projector_create(&view->project, error) || !gpu_fluid_create(&view->fluid, error))
        return false;
    surface_gpu_create(&view->walks);
    for (int i = 0; i < PBSR_LAYERS_MAX; i++)
        view->rigid[i].gpu = &view->walks;
    return true;
}

static void *create(const Subject *subject, Error *error)
{
    PbsrView *view = calloc(1, sizeof *view);
    if (!view) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    const bool by_cpu = projects_on_cpu(pbsr_def(subject->def));
    if (average_create(&view->average, subject, by_cpu, error) && (by_cpu || create_gpu(view, error)) &&
        shadow_caster_create(&view->casting, NULL, error))
        return view;
    destroy(view);
    return NULL;
}

static void cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    const PbsrView *view = state;
    (void)frame;
    shadow_caster_draw(&view->casting, particles);
}

/* ---- inputs of a picture ---- */

/* For structs zeroed first, so that padding is 0. */
static bool same_bytes(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static Scalar color_of(const Frame *frame)
{
    return frame->colors.by_fluid ? SCALAR_FLUID : view_color_by(frame->def);
}

static void layers_from(LayersFrom *from, const ParticleBuffers *particles, const Frame *frame)
{
    memset(from, 0, sizeof *from);
    memcpy(&from->def, pbsr_def(frame->def), sizeof from->def);
    from->def.repeat = from->def.moving = 0;
    from->def.budget = from->def.points = from->def.edges = from->def.seed = 0;
    for (int i = 0; i < from->def.layer_count; i++) { /* a new pose needs no new layer, but of a slice */
        PbsrLayer *layer = &from->def.layers[i];
        if (pbsr_is_slice(layer))
            continue;
        layer->angle_deg = 0;
        memset(layer->position, 0, sizeof layer->position);
        memset(layer->axis, 0, sizeof layer->axis);
        layer->motion_count = 0;
        layer->motions = NULL;
    }
    from->step = particles->step;
    from->time = particles->time;
    from->count = particles->count;
    from->buffer = particles->position.buffer;
    from->offset = particles->position.offset;
    from->color = color_of(frame);
    memcpy(from->box_size, particles->box_size, sizeof from->box_size);
    from->spacing = particles->spacing;
    from->support = particles->support_radius;
    memcpy(&from->world, frame->world, sizeof from->world);
}

static void picture_from(PictureFrom *from, const LayersFrom *layers, const Frame *frame)
{
    memset(from, 0, sizeof *from);
    memcpy(&from->layers, layers, sizeof *layers);
    memcpy(&from->def, frame->def, sizeof from->def);
    from->camera = frame->camera;
    memcpy(from->box_to_world, frame->box_to_world, sizeof from->box_to_world);
    memcpy(from->range, frame->colors.range, sizeof from->range);
    from->target = frame->target->number;
    from->plain = frame->plain;
    from->split = frame_over_depth(frame) != 0;
    from->coarse = frame->over && frame->over->coarse;
}

static void turn_of(const PbsrLayer *said, float turn[3][3])
{
    double of[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (pbsr_is_rigid(said))
        rigid_rotation(said, of);
    for (int i = 0; i < 9; i++)
        turn[i / 3][i % 3] = (float)of[i / 3][i % 3];
}

static bool leaves_box(const PbsrDef *def, const double box[3])
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers(def, said);
    for (int i = 0; i < count; i++)
        if (said[i].of == PBSR_SOLIDS || rigid_leaves_box(&said[i], box))
            return true;
    return false;
}

static void find_looks(const PbsrDef *def, double time, const WorldDef *world, bool by_gpu,
                       AverageLook looks[AVERAGE_NUMBERS_MAX])
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers_at(def, time, said);
    memset(looks, 0, AVERAGE_NUMBERS_MAX * sizeof *looks);
    for (int i = 0; i < count; i++) {
        looks[i].own = pbsr_has_color(&said[i]);
        looks[i].lit = said[i].of != PBSR_VOLUME && (said[i].of < PBSR_SLICE_X || said[i].of > PBSR_SLICE_Z);
        looks[i].by_map = pbsr_is_of_file(&said[i]);
        turn_of(&said[i], looks[i].turn);
        for (int k = 0; k < 3; k++)
            looks[i].color[k] = (float)said[i].color[k];
    }
    solid_layers_fill_looks(def, world, looks);
    looks[OUTSIDE_NUMBER] = (AverageLook){
        .own = true, .color = {0.5F, 0.5F, 0.5F}, .lit = true, .turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int i = 0; by_gpu && i < count; i++)
        if (pbsr_takes_fluid_colors(&said[i])) {
            looks[i].own = true;
            memcpy(looks[i].color, looks[OUTSIDE_NUMBER].color, sizeof looks[i].color);
        }
}

/* If no further pictures follow, as for a file, rigid layers make all sets at once. */
static void hurry(PbsrView *view, const PbsrDef *def, const Frame *frame)
{
    const int moving = !frame->more ? 0 : def->moving > 0 ? def->moving : FEW_SETS;
    for (int i = 0; i < PBSR_LAYERS_MAX; i++)
        view->rigid[i].moving = moving;
    view->solids.moving = moving;
}

static bool layers_wait(const PbsrView *view)
{
    bool any = false;
    for (int k = 0; k < view->layers.count; k++)
        any |= rigid_layer_is_unfinished(&view->rigid[k]);
    for (int k = 0; k < view->solids.count; k++)
        any |= rigid_layer_is_unfinished(&view->solids.rigid[k]);
    return any;
}

/* Updates the parts of layers that depend on the sight. */
static bool see_layers(PbsrView *view, const ParticleBuffers *particles, const PbsrDef *def,
                       const Frame *frame)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers_at(def, particles->time, said);
    FluidFieldJob job;
    hurry(view, def, frame);
    fluid_field_job(&job, def, particles, color_of(frame), frame->slab);
    if (view->project.program && !gpu_fluid_see(&view->fluid, &view->layers, def, &job, &view->project,
                                                &view->average.sight, frame->stale != NULL, &view->trouble))
        return false;
    for (int i = 0; i < count; i++) {
        if (!layer_make_shares(&view->layers.layers[i], &view->average.sight))
            return error_set(&view->trouble, "no memory for the points of a layer");
        fluid_walk_select(&view->steps[i], &said[i], &view->layers.layers[i], &view->average.sight);
        (void)rigid_layer_update(&view->rigid[i], &said[i], def, particles->box_size, (unsigned)i,
                                 &view->average.sight); /* a layer that fails is left out, and the note
                                                           says so */
        rigid_layer_set_colors(&view->rigid[i], &said[i], &view->layers);
        if (view->project.program &&
            !projector_upload(&view->project, i, layer_pieces(&view->rigid[i], &view->layers.layers[i]),
                              &view->rigid[i], &view->trouble))
            return false;
    }
    solid_layers_update(&view->solids, def, particles->time, frame, &view->average.sight);
    for (int i = 0; view->project.program && i < view->solids.count; i++)
        if (!projector_upload_solid(&view->project, i, &view->solids.rigid[i], &view->trouble))
            return false;
    return true;
}

static bool make_layers(PbsrView *view, const ParticleBuffers *particles, const Frame *frame)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const PbsrDef *def = pbsr_def(frame->def);
    FluidFieldJob job;
    fluid_field_job(&job, def, particles, color_of(frame), frame->slab);
    if (view->project.program ? !gpu_fluid_make(&view->fluid, &view->layers, def, &job, frame->neighbourhood,
                                                view->project.block_bytes, &view->trouble)
                              : !fluid_layers_make(&view->layers, def, &job, &view->trouble))
        return false;
    for (int i = 0; i < pbsr_layers(def, said); i++)
        fluid_walk_begin(&view->steps[i], &said[i], &view->layers, particles, frame->slab,
                         view->project.program != 0);
    return true;
}

/* Updates layers and sums for this picture; valid results of the last picture stay. */
static bool follow(PbsrView *view, const ParticleBuffers *particles, const Frame *frame)
{
    AverageLook looks[AVERAGE_NUMBERS_MAX];
    LayersFrom layers;
    PictureFrom picture;
    layers_from(&layers, particles, frame);
    picture_from(&picture, &layers, frame);
    const bool same_layers = view->valid && same_bytes(&layers, &view->made, sizeof layers);
    if (view->valid && same_bytes(&picture, &view->drawn, sizeof picture) && !layers_wait(view) &&
        !gpu_fluid_lacks_room(&view->fluid, &view->layers, pbsr_def(frame->def)))
        return true;
    view->valid = false;
    find_looks(pbsr_def(frame->def), particles->time, frame->world, view->project.program != 0, looks);
    if ((!same_layers && !make_layers(view, particles, frame)) ||
        !average_begin(&view->average, frame, looks, leaves_box(pbsr_def(frame->def), particles->box_size),
                       &view->trouble) ||
        !see_layers(view, particles, pbsr_def(frame->def), frame))
        return false;
    memcpy(&view->made, &layers, sizeof layers);
    memcpy(&view->drawn, &picture, sizeof picture);
    return view->valid = true;
}

/* ---- sets of a picture ---- */

typedef struct ProjectJob {
    const PbsrView *view;
    uint64_t seed;
    int first; /* number of the set in the buffer's first place */
} ProjectJob;

static void project_some(void *context, size_t begin, size_t end)
{
    const ProjectJob *projecting = context;
    const PbsrView *view = projecting->view;
    for (size_t i = begin; i < end; i++) {
        const SetImage image = average_image(&view->average, (int)i);
        set_image_clear(&image, &view->average.sight);
        const uint64_t set = (uint64_t)projecting->first + i;
        for (int k = 0; k < view->layers.count; k++) {
            if (view->steps[k].walks)
                rigid_layer_project(&view->steps[k].rigid, projecting->seed, set, &image);
            else
                layer_project(&view->layers.layers[k], projecting->seed, set, &view->average.sight, &image);
            rigid_layer_project(&view->rigid[k], projecting->seed, set, &image);
        }
        for (int k = 0; k < view->solids.count; k++)
            rigid_layer_project(&view->solids.rigid[k], projecting->seed, set, &image);
    }
}

static void walk_on_fluid(PbsrView *view, int count, const PbsrDef *def)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    pbsr_layers(def, said);
    for (int i = 0; i < view->layers.count; i++)
        fluid_walk_sample(&view->steps[i], &said[i], &view->layers, (unsigned)i, def->seed,
                          view->average.count, count);
}

static void project_sets(PbsrView *view, int count, int seed)
{
    const int first = view->average.count;
    ProjectJob projecting = {view, (uint64_t)seed, first};
    const ProjectorSets sets = {
        view->layers.layers, view->rigid, &view->solids, view->layers.count, seed, first, count};
    if (view->project.program)
        projector_run(&view->project, &view->average, &sets);
    else
        parallel_ranges(parallel_processors(), (size_t)count, 1, project_some, &projecting);
}

static void add_sets(PbsrView *view, int count, const Frame *frame)
{
    GL_STAGE(frame->timer, STAGE_VOXELIZE)
    walk_on_fluid(view, count, pbsr_def(frame->def));
    for (int band = 0; average_band(&view->average, band); band++) {
        GL_STAGE(frame->timer, STAGE_BLEND)
        project_sets(view, count, pbsr_def(frame->def)->seed);
        GL_STAGE(frame->timer, STAGE_SHADE)
        average_add(&view->average, count, frame);
    }
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

static bool walks_on_fluid(const PbsrView *view)
{
    for (int i = 0; i < view->layers.count; i++)
        if (view->steps[i].walks)
            return true;
    return false;
}

/* Adds as many sets at a time as there are threads; one set if a walk on the fluid uses all threads. The
   first sets are drawn at any cost. */
static void add_in_budget(PbsrView *view, double begun, const Frame *frame)
{
    const PbsrDef *def = pbsr_def(frame->def);
    const int some = walks_on_fluid(view) ? 1
                                          : least(view->average.capacity,
                                                  parallel_processors() > 1 ? parallel_processors() : 2);
    double cost = 0;
    for (bool first = true;
         view->average.count < view->there && (first || wall_ms() - begun + cost <= def->budget);
         first = false) {
        const double before = wall_ms();
        add_sets(view, least(some, view->there - view->average.count), frame);
        cost = wall_ms() - before;
    }
}

/* Kept points fill as many sets as memory allows: drawing a set twice adds no information. */
static void limit_sets(PbsrView *view, const RigidLayer *rigid)
{
    if (rigid->sets == 0)
        return;
    view->there = least(view->there, rigid->sets);
    if (!rigid->few)
        view->wanted = least(view->wanted, rigid->sets);
}

static void find_sets_wanted(PbsrView *view, const PbsrDef *def)
{
    view->wanted = view->there = def->repeat;
    for (int k = 0; k < view->layers.count; k++)
        limit_sets(view, &view->rigid[k]);
    for (int k = 0; k < view->solids.count; k++)
        limit_sets(view, &view->solids.rigid[k]);
}

/* Adds a picture's sets to the mean, up to all wanted sets. */
static void add_wanted(PbsrView *view, double begun, const Frame *frame)
{
    const PbsrDef *def = pbsr_def(frame->def);
    const int some = def->moving > 0 ? def->moving : view->project.program ? GPU_SETS : 0;
    find_sets_wanted(view, def);
    if (frame->more && some == 0) {
        add_in_budget(view, begun, frame);
        return;
    }
    const int capacity =
        walks_on_fluid(view) ? least(view->average.capacity, FLUID_WALK_SETS) : view->average.capacity;
    const int most = frame->more ? least(view->average.count + some, view->there) : view->there;
    while (view->average.count < most)
        add_sets(view, least(capacity, most - view->average.count), frame);
}

/* Called once per picture. */
static void find_lacks(PbsrView *view, const Frame *frame)
{
    const PbsrDef *def = pbsr_def(frame->def);
    const DrawnLayers drawn = {.def = def,
                               .layers = &view->layers,
                               .walks = view->steps,
                               .rigid = view->rigid,
                               .solids = &view->solids,
                               .by_gpu = view->project.program != 0,
                               .sets = view->wanted,
                               .uncounted = view->uncounted,
                               .overlay_depth_missing = frame->over && !frame->over->depth};
    view->lacked = layers_describe_missing(&drawn, view->lack, sizeof view->lack);
}

/* The GPU's pieces are read back for this alone. */
static bool count_points(PbsrView *view, const Frame *frame)
{
    bool counted = true;
    for (int i = 0; counted && i < view->layers.count; i++)
        if (view->layers.layers[i].on_gpu)
            counted = gpu_fluid_read(&view->fluid, &view->project, i, &view->layers.layers[i]);
    counted = counted && count_set_points(&view->layers, view->steps, view->rigid, &view->solids,
                                          &view->average.sight, view->added, frame);
    for (int i = 0; i < view->layers.count; i++)
        if (view->layers.layers[i].on_gpu)
            (void)layer_reserve(&view->layers.layers[i], 0, 0); /* empty again */
    return counted;
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    PbsrView *view = state;
    const double begun = wall_ms();
    bool made = false;
    GL_STAGE(frame->timer, STAGE_VOXELIZE)
    made = follow(view, particles, frame);
    if (!made) { /* memory that was there before may be gone: the note says so */
        view->average.count = 0;
        return;
    }
    const int before = view->average.count;
    add_wanted(view, begun, frame);
    if (!frame->counts)
        view->added = view->average.count - before;
    view->uncounted = frame->counts && !count_points(view, frame);
    find_lacks(view, frame);
    average_show_back(&view->average, frame);
}

static void draw_front(void *state, const Frame *frame)
{
    const PbsrView *view = state;
    GL_STAGE(frame->timer, STAGE_SHADE)
    average_show_front(&view->average, frame);
}

/* The value under the mouse is of the nearest point of all sets. */
static ViewProbing probing(const void *state, const ViewDef *def)
{
    (void)state;
    (void)def;
    return (ViewProbing){.by = VIEW_PROBE_MEAN};
}

static bool unfinished(const void *state)
{
    const PbsrView *view = state;
    return view->valid &&
           (view->average.count < view->wanted || layers_wait(view) || view->fluid.found.fence);
}

static const char *missing(const void *state)
{
    const PbsrView *view = state;
    if (view->average.count == 0)
        return view->trouble.message;
    return view->lacked > 0 ? view->lack : NULL;
}

static const char *note(void *state, bool *stale)
{
    PbsrView *view = state;
    (void)stale;
    const int count = view->average.count;
    if (count == 0)
        return view->trouble.message;
    snprintf(view->note, sizeof view->note, "%s%s%d of %d sets, noise up to %.2g %%", view->lack,
             view->lacked > 0 ? "; " : "", count, view->wanted, 100 * opacity_noise(0.5, count));
    return view->note;
}

/* In the legend, solids of several colours have the first solid's colour. */
static float part_color(const WorldDef *world, const PbsrLayer *layer, int k)
{
    if (layer->of == PBSR_SOLIDS && !pbsr_has_color(layer) && world->solid_count > 0)
        return world->solids[0].color[k];
    return (float)layer->color[k];
}

/* Lists the def's layers in the legend; the colour bar is shown if a layer uses it. */
static void show(const ViewDef *def, Frame *frame)
{
    const PbsrDef *own = pbsr_def(def);
    frame->colors.part_count = own->layer_count;
    frame->colors.none = own->layer_count > 0;
    frame->no_solids = solid_layers_number(own) >= 0;
    for (int i = 0; i < own->layer_count; i++) {
        const PbsrLayer *layer = &own->layers[i];
        FramePart *part = &frame->colors.parts[i];
        part->own = pbsr_has_color(layer) || layer->of == PBSR_SOLIDS;
        frame->colors.none &= part->own || pbsr_is_of_file(layer); /* the bar is of the fluid's scalar */
        for (int k = 0; k < 3; k++)
            part->color[k] = part_color(frame->world, layer, k);
        layer_text(layer, part->words);
    }
}

static void want(const ViewDef *def, ParticleWants *wants)
{
    wants->scalars |= pbsr_scalars(pbsr_def(def));
    wants->neighbours |= pbsr_def(def)->method != PBSR_CPU;
}

const ViewKind view_pbsr = {
    .name = "pbsr",
    .samples = true,
    .help = "transparent surfaces, slices and volume of points, without sorting",
    .radius = 0.5,
    .keys = pbsr_keys,
    .grades = pbsr_grades,
    .def = &pbsr_usual,
    .def_size = sizeof pbsr_usual,
    .check = check,
    .files = pbsr_files,
    .want = want,
    .create = create,
    .destroy = destroy,
    .show = show,
    .cast = cast,
    .draw = draw,
    .draw_front = draw_front,
    .unfinished = unfinished,
    .note = note,
    .missing = missing,
    .probing = probing,
};
