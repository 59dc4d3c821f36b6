#include "render/particles/particles.h"
#include "render/views/pbsr/pbsr_private.h"
#include "shaders/pbsr/pbsr_bindings.h"
#include "shaders/shared/bindings.h"
#include "sim/gpu/gl.h"
#include "sim/mesh.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(offsetof(PiecesFound, largest) == 4 * PIECES_LARGEST &&
                   offsetof(PiecesFound, there) == 4 * PIECES_THERE,
               "words of the shaders");

/* Room of a layer before any answer: of a tenth of a million particles, more than the surface has. */
enum { PIECES_FIRST_ROOM = 65536 };

/* ---- programs and constant buffers ---- */

static unsigned constant_buffer(size_t size, const void *data, const char *label)
{
    unsigned buffer;
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, label);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, data, 0);
    return buffer;
}

static void make_cases(GpuFluid *gpu)
{
    enum { WORDS = 1 + 3 * ISO_TRIANGLES_MOST };
    IsoCases cases;
    static const GLuint nothing[4] = {0};
    GLuint words[ISO_CASES * WORDS];
    isosurface_cases(&cases);
    for (int c = 0; c < ISO_CASES; c++) {
        words[WORDS * c] = cases.triangles[c];
        for (int k = 1; k < WORDS; k++)
            words[WORDS * c + k] = cases.edge[c][k - 1];
    }
    gpu->cases = constant_buffer(sizeof words, words, "cases of a cube");
    gpu->none = constant_buffer(sizeof nothing, nothing, "no scalar");
    gpu->no_colors = constant_buffer(sizeof nothing, nothing, "no colours");
}

static unsigned compile(const char *file, const char *defines, Error *error)
{
    return program_create(file, (const char *const[]){file, NULL}, defines, error);
}

bool gpu_fluid_create(GpuFluid *gpu, Error *error)
{
    if (!(gpu->sum = compile("pbsr/field.comp", NULL, error)) ||
        !(gpu->count = compile("pbsr/pieces.comp", "#define COUNT 1\n", error)) ||
        !(gpu->emit = compile("pbsr/pieces.comp", NULL, error)) ||
        !(gpu->share = compile("pbsr/share.comp", NULL, error)) || !prefix_sums_create(&gpu->sums, error))
        return false;
    make_cases(gpu);
    return mailbox_create(&gpu->found, "pieces found", sizeof(PiecesFound)) ||
           error_set(error, "no memory for the layers of the view");
}

void gpu_fluid_destroy(GpuFluid *gpu)
{
    const GLuint programs[] = {gpu->sum, gpu->count, gpu->emit, gpu->share};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++)
        glDeleteProgram(programs[i]);
    prefix_sums_destroy(&gpu->sums);
    glDeleteBuffers(5, (GLuint[]){gpu->cases, gpu->none, gpu->no_colors, gpu->field, gpu->starts});
    glDeleteBuffers(FLUID_MEANS_MAX, gpu->mean);
    mailbox_destroy(&gpu->found);
    *gpu = (GpuFluid){0};
}

/* ---- the field ---- */

static size_t cells_of(const FluidField *fluid)
{
    return volume_grid_cells(&fluid->grid);
}

/* The grid covers the box, and a support radius around fluid that is a support radius outside. */
static void make_grid(FluidField *fluid, const FluidFieldJob *job, int64_t block_bytes)
{
    static const double CELLS_MAX = 134217728.0;
    const double *box = job->particles->box_size;
    const double low[3] = {-box[0] / 2, 0, -box[2] / 2}, high[3] = {box[0] / 2, box[1], box[2] / 2};
    fluid_field_set_grid(fluid, job, low, high, 2 * job->particles->support_radius,
                         fmin(CELLS_MAX, (double)block_bytes / sizeof(GLuint) - 1));
    if (job->flat > 0)
        fluid_field_deepen(fluid, job->flat);
}

static bool reserve(unsigned *buffer, size_t *capacity, size_t cells, const char *label)
{
    if (cells <= *capacity)
        return true;
    *capacity = work_buffer_try(buffer, (cells + 1) * sizeof(GLuint), label) ? cells : 0;
    return *capacity > 0;
}

static bool reserve_cells(GpuFluid *gpu, const FluidFieldJob *job, size_t cells)
{
    size_t starts = gpu->cells;
    bool made = reserve(&gpu->field, &gpu->cells, cells, "fluid field") &&
                reserve(&gpu->starts, &starts, cells, "pieces before");
    for (int m = 0; made && m < job->means; m++)
        made = reserve(&gpu->mean[m], &gpu->mean_cells[m], cells, "fluid mean");
    if (!made)
        gpu->cells = 0;
    return made;
}

static void set_grid(const FluidField *fluid, bool flat)
{
    const double *corner = fluid->grid.corner, *side = fluid->side;
    const int *size = fluid->grid.size;
    glUniform3ui(VALUES_SIZE_AT, (GLuint)size[0], (GLuint)size[1], (GLuint)size[2]);
    glUniform3f(VALUES_CORNER_AT, (GLfloat)corner[0], (GLfloat)corner[1], (GLfloat)corner[2]);
    glUniform3f(VALUES_SIDE_AT, (GLfloat)side[0], (GLfloat)side[1], (GLfloat)side[2]);
    glUniform1ui(VALUES_FLAT_AT, flat);
}

/* Without a mean, `mean` is -1. */
static void sum_field(const GpuFluid *gpu, const FluidField *fluid, const FluidFieldJob *job, int mean,
                      const Neighbourhood *near)
{
    const ParticleBuffers *particles = job->particles;
    const double *box = particles->box_size;
    const Scalar scalar = mean >= 0 ? job->scalar[mean] : SCALAR_SPEED;
    const ParticleAttribute missing = {0};
    const ParticleAttribute *shown = mean >= 0 ? particle_color_attribute(particles, scalar) : &missing;
    particle_bind_one(POSITIONS_STORAGE, &particles->position, particles->count, 0);
    glUseProgram(gpu->sum);
    glUniform1ui(POSITION_STRIDE_AT, (GLuint)(particles->position.stride / 4));
    glUniform1ui(SHOWN_STRIDE_AT, particle_bind_one(SHOWN_STORAGE, shown, particles->count, gpu->none));
    glUniform1ui(SHOWN_IS_FLUID_AT, scalar == SCALAR_FLUID);
    glUniform1f(FIELD_SUPPORT_AT, (GLfloat)particles->support_radius);
    glUniform1f(FIELD_PEAK_AT, (GLfloat)fluid_field_peak(job->flat, particles->support_radius));
    glUniform3f(FIELD_BOX_AT, (GLfloat)box[0], (GLfloat)box[1], (GLfloat)box[2]);
    glUniform1ui(FIELD_HAS_MEAN_AT, mean >= 0);
    set_grid(fluid, job->flat > 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, PBSR_FIELD_STORAGE, 2,
                      (GLuint[]){gpu->field, mean >= 0 ? gpu->mean[mean] : gpu->none});
    neighbourhood_run_for(near, gpu->sum, cells_of(fluid));
}

static void clear(unsigned buffer)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferData(buffer, GL_R32F, GL_RED, GL_FLOAT, NULL);
}

static void sum_all(const GpuFluid *gpu, const FluidField *fluid, const FluidFieldJob *job,
                    Neighbourhood *near)
{
    if (job->particles->count == 0) {
        clear(gpu->field);
        for (int m = 0; m < job->means; m++)
            clear(gpu->mean[m]);
        return;
    }
    neighbourhood_build(near, job->particles);
    for (int m = job->means > 0 ? 0 : -1; m < job->means; m++)
        sum_field(gpu, fluid, job, m, near);
}

/* The fluid's layers alone have pieces here, not those of files, formulas and solids. */
static bool has_pieces(const PbsrLayer *said)
{
    return !pbsr_is_rigid(said) && said->of != PBSR_SOLIDS;
}

bool gpu_fluid_make(GpuFluid *gpu, FluidLayers *layers, const PbsrDef *def, const FluidFieldJob *job,
                    Neighbourhood *near, int64_t block_bytes, Error *error)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    FluidField *fluid = &layers->fluid;
    layers->count = 0;
    make_grid(fluid, job, block_bytes);
    if (!reserve_cells(gpu, job, cells_of(fluid)))
        return error_set(
            error, "the GPU has no memory for a grid of %d x %d x %d cells: take a larger view.pbsr.cell",
            fluid->grid.size[0], fluid->grid.size[1], fluid->grid.size[2]);
    fluid->means = job->means;
    memcpy(fluid->scalar, job->scalar, sizeof fluid->scalar);
    sum_all(gpu, fluid, job, near);
    const int count = pbsr_layers(def, said);
    for (int i = 0; i < count; i++) {
        LayerPieces *layer = &layers->layers[i];
        const bool cells = layer->cells;
        fluid_layer_describe(layer, fluid, job, def, &said[i], i);
        if (layer->cells != cells || !has_pieces(&said[i]))
            layer->on_gpu = 0;
    }
    layers->count = count;
    gpu->made = false;
    return true;
}

/* ---- pieces ---- */

/* Where the pieces of a layer come from. */
typedef struct PieceSource {
    unsigned of; /* PIECES_OF_ */
    unsigned levels;
    SliceGrid slice;
    size_t items;
} PieceSource;

static PieceSource source_of(const GpuFluid *gpu, const FluidField *fluid, const FluidFieldJob *job,
                             const PbsrLayer *said)
{
    PieceSource source = {.of = PIECES_OF_FIELD, .levels = gpu->none, .items = cells_of(fluid)};
    if (said->of == PBSR_VOLUME)
        source.of = PIECES_OF_VOLUME;
    else if (said->of >= PBSR_SCALARS) {
        source.of = PIECES_OF_SCALAR;
        source.levels = gpu->mean[fluid_field_mean_of(fluid, (Scalar)(said->of - PBSR_SCALARS))];
    } else if (said->of >= PBSR_SLICE_X && said->of <= PBSR_SLICE_Z) {
        source.of = PIECES_OF_SLICE;
        fluid_slice_grid(fluid, job->particles->box_size, said, &source.slice);
        source.items = (size_t)source.slice.count[0] * (size_t)source.slice.count[1];
    }
    return source;
}

static void set_slice(const SliceGrid *slice)
{
    GLfloat along[2][3];
    for (int i = 0; i < 6; i++)
        along[i / 3][i % 3] = (GLfloat)slice->along[i / 3][i % 3];
    glUniform3f(PIECES_CORNER_AT, (GLfloat)slice->corner[0], (GLfloat)slice->corner[1],
                (GLfloat)slice->corner[2]);
    glUniform3fv(PIECES_ALONG_AT, 2, along[0]);
    glUniform2ui(PIECES_SQUARES_AT, (GLuint)slice->count[0], (GLuint)slice->count[1]);
}

static void begin_pass(const GpuFluid *gpu, unsigned program, const FluidField *fluid,
                       const FluidFieldJob *job, const PbsrLayer *said, const PieceSource *source)
{
    const int color = job->colored ? fluid_field_mean_of(fluid, job->color) : -1;
    const unsigned colors = color >= 0 ? gpu->mean[color] : gpu->no_colors;
    const bool same = colors == source->levels; /* a buffer stands in one block alone */
    glUseProgram(program);
    set_grid(fluid, job->flat > 0);
    glUniform1ui(PIECES_OF_AT, source->of);
    glUniform1f(PIECES_LEVEL_AT, (GLfloat)said->level);
    set_slice(&source->slice);
    if (program == gpu->emit)
        glUniform1ui(PIECES_COLORED_AT, color < 0 ? 0 : same ? PIECES_BY_LEVELS : PIECES_BY_COLORS);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, PIECES_COLORS_STORAGE, 4,
                      (GLuint[]){same ? gpu->no_colors : colors, gpu->field, source->levels, gpu->starts});
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PIECES_CASES_STORAGE, gpu->cases);
}

static void make_pieces(GpuFluid *gpu, const FluidLayers *layers, const FluidFieldJob *job,
                        const PbsrLayer *said, int index, const Projector *project)
{
    const FluidField *fluid = &layers->fluid;
    const LayerPieces *layer = &layers->layers[index];
    const PieceSource source = source_of(gpu, fluid, job, said);
    PieceRange range = {0};
    begin_pass(gpu, gpu->count, fluid, job, said, &source);
    work_run(source.items + 1);
    prefix_sums_run(&gpu->sums, gpu->starts, source.items + 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(gpu->starts, gpu->found.buffer, (GLintptr)(source.items * sizeof(GLuint)),
                             (GLintptr)((size_t)index * sizeof(GLuint)), sizeof(GLuint));
    begin_pass(gpu, gpu->emit, fluid, job, said, &source);
    while (projector_next_range(project, index, layer_piece_bytes(layer), layer->on_gpu, &range))
        work_run(source.items);
}

/* ---- shares ---- */

static void set_look(const SetSight *sight)
{
    glUniform4fv(PIECE_SIGHT_AT, 3, sight->row[0]);
    glUniform4f(PIECE_EYE_AT, sight->eye[0], sight->eye[1], sight->eye[2], sight->edges);
    glUniform4f(SHARE_VIEW_AT, (GLfloat)sight->width, (GLfloat)sight->height, sight->near_plane,
                sight->pixel);
}

static void make_shares(const GpuFluid *gpu, const LayerPieces *layer, int index, const Projector *project)
{
    PieceRange range = {0};
    glUniform1ui(PIECE_LAYER_AT, (GLuint)index);
    glUniform1ui(PIECE_KIND_AT, layer->cells ? PIECE_CELLS : PIECE_LOOSE);
    glUniform4f(PIECE_CELL_AT, (GLfloat)layer->cell[0], (GLfloat)layer->cell[1], (GLfloat)layer->cell[2], 0);
    glUniform3f(SHARE_DENSITY_AT, (GLfloat)layer->density, (GLfloat)layer->curved, (GLfloat)layer->support);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PIECES_FOUND_STORAGE, gpu->found.buffer);
    while (projector_next_range(project, index, layer_piece_bytes(layer), layer->on_gpu, &range))
        work_run(range.count);
}

/* Makes the pieces that are not made, and all shares. */
static void run_passes(GpuFluid *gpu, const FluidLayers *layers, const FluidFieldJob *job,
                       const PbsrLayer *said, const Projector *project, const SetSight *sight)
{
    static const GLuint zero = 0;
    for (int i = 0; !gpu->made && i < layers->count; i++)
        if (has_pieces(&said[i]))
            make_pieces(gpu, layers, job, &said[i], i, project);
    gpu->made = true;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferSubData(gpu->found.buffer, GL_R32UI, offsetof(PiecesFound, largest),
                              sizeof(PiecesFound) - offsetof(PiecesFound, largest), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
    glUseProgram(gpu->share);
    set_look(sight);
    for (int i = 0; i < layers->count; i++)
        if (has_pieces(&said[i]))
            make_shares(gpu, &layers->layers[i], i, project);
}

/* Takes an answer; NULL: none. */
static void take(GpuFluid *gpu, FluidLayers *layers, const PbsrLayer *said, const PiecesFound *found)
{
    if (!found)
        return;
    gpu->known = true;
    gpu->answer = *found;
    gpu->lacking = 0;
    for (int i = 0; i < layers->count; i++) {
        LayerPieces *layer = &layers->layers[i];
        if (!has_pieces(&said[i]))
            continue;
        layer->largest = float_of_bits(found->largest[i]);
        layer->beyond = (double)(layer->largest / EXPECTED_MOST);
        layer->there = found->there[i] != 0;
        gpu->lacking |= (unsigned)(found->pieces[i] > layer->on_gpu) << i;
    }
}

bool gpu_fluid_lacks_room(GpuFluid *gpu, FluidLayers *layers, const PbsrDef *def)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    pbsr_layers(def, said);
    take(gpu, layers, said, gpu->found.fence ? mailbox_look(&gpu->found) : NULL);
    return gpu->lacking != 0;
}

static bool reserve_layer(LayerPieces *layer, int index, size_t pieces, const Projector *project,
                          Error *error)
{
    layer->on_gpu = pieces;
    if (!projector_reserve(project, index, layer, error))
        layer->on_gpu = 0;
    return layer->on_gpu > 0;
}

/* Makes room for half as many again, so that a splash fits into the next pictures. */
static bool grow(GpuFluid *gpu, FluidLayers *layers, const Projector *project, Error *error)
{
    const unsigned lacking = gpu->lacking;
    gpu->made = gpu->made && !lacking;
    gpu->lacking = 0;
    for (int i = 0; i < layers->count; i++)
        if ((lacking >> i & 1) &&
            !reserve_layer(&layers->layers[i], i, gpu->answer.pieces[i] / 2 * (size_t)3 + 1, project, error))
            return false;
    return true;
}

/* Room of layers without any. */
static bool begin_room(FluidLayers *layers, const PbsrLayer *said, const Projector *project, Error *error)
{
    for (int i = 0; i < layers->count; i++)
        if (has_pieces(&said[i]) && layers->layers[i].on_gpu == 0 &&
            !reserve_layer(&layers->layers[i], i, PIECES_FIRST_ROOM, project, error))
            return false;
    return true;
}

bool gpu_fluid_see(GpuFluid *gpu, FluidLayers *layers, const PbsrDef *def, const FluidFieldJob *job,
                   const Projector *project, const SetSight *sight, bool late, Error *error)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const bool waits = !late || !gpu->known;
    pbsr_layers_at(def, job->particles->time, said);
    if (!begin_room(layers, said, project, error))
        return false;
    if (!waits)
        gpu_fluid_lacks_room(gpu, layers, def);
    do {
        if (!grow(gpu, layers, project, error))
            return false;
        run_passes(gpu, layers, job, said, project, sight);
        if (waits || !gpu->found.fence)
            mailbox_send(&gpu->found);
        if (waits)
            take(gpu, layers, said, mailbox_wait(&gpu->found));
    } while (gpu->lacking);
    return true;
}

bool gpu_fluid_read(const GpuFluid *gpu, const Projector *project, int index, LayerPieces *layer)
{
    const unsigned *from = project->layers[index].buffers;
    PiecesFound found;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(gpu->found.buffer, 0, sizeof found, &found);
    const size_t pieces = found.pieces[index] < layer->on_gpu ? found.pieces[index] : layer->on_gpu;
    const size_t triangles = layer->cells ? 0 : pieces, points = layer->cells ? pieces : 3 * pieces;
    if (!layer_reserve(layer, points, triangles) || !layer_reserve_shares(layer, pieces))
        return false;
    glGetNamedBufferSubData(from[PIECES_POINTS], 0, (GLsizeiptr)(points * sizeof *layer->point),
                            layer->point);
    glGetNamedBufferSubData(from[PIECES_SHARES], 0, (GLsizeiptr)(pieces * sizeof *layer->share),
                            layer->share);
    for (size_t i = 0; i < 3 * triangles; i++)
        layer->triangle[i / 3][i % 3] = (uint32_t)i;
    layer->point_count = points;
    layer->triangle_count = triangles;
    return true;
}
