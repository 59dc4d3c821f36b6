#include "render/frame/passes.h"
#include "render/particles/particles.h"
#include "render/views/volume/volume_private.h"
#include "shaders/volume/solid_shares_block.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/base/base.h"
#include "sim/gpu/gl.h"
#include "sim/kernel/kernel.h"
#include "sim/mesh/mesh_shape.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(SOLID_SHARES_MAX == SOLIDS_MAX, "a block for each solid of a scene");

/* NODES: to the kernel's radius; a block has no more than NODES_MOST, wider apart if need be. */
enum { NODES = 4, NODES_MOST = 1 << 21 };

/* The least part of the kernel left free: deeper in a solid the field is unchanged. */
static const double LEAST_FREE = 0.35;

/* A grid of nodes around a solid, in the solid's frame, and the kernel on it. */
typedef struct ShareBlock {
    const SolidDef *solid;
    bool flat;
    int size[3];
    double low[3], apart, support; /* m */
    float *inside;                 /* the part of each node's cell in the solid, 0 .. 1 */
    float *share;                  /* the result */
} ShareBlock;

static size_t count_of(const int size[3])
{
    return (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
}

/* Returns the number of nodes at this distance; the outermost are farther from the solid than the kernel
   reaches. */
static double space_nodes(ShareBlock *block, const double low[3], const double high[3], double apart)
{
    double nodes = 1;
    for (int k = 0; k < 3; k++) {
        const bool across = block->flat && k == 2;
        const double cells = across ? 0 : ceil((high[k] - low[k] + 2 * (block->support + apart)) / apart);
        block->size[k] = (int)fmin(cells, NODES_MOST) + 1;
        block->low[k] = 0.5 * (low[k] + high[k] - (block->size[k] - 1) * apart);
        nodes *= block->size[k];
    }
    block->apart = apart;
    return nodes;
}

static void place_nodes(ShareBlock *block, double spacing)
{
    double low[3], high[3], apart = block->support / NODES;
    solid_voxels_bounds(block->solid, block->flat ? spacing : 0, low, high);
    while (space_nodes(block, low, high, apart) > NODES_MOST)
        apart *= 1.1;
}

static size_t node_number(const ShareBlock *block, int i, int j, int k)
{
    return ((size_t)k * (size_t)block->size[1] + (size_t)j) * (size_t)block->size[0] + (size_t)i;
}

static void fill_inside(void *context, size_t begin, size_t end)
{
    const ShareBlock *block = context;
    for (size_t k = begin; k < end; k++)
        for (int j = 0; j < block->size[1]; j++)
            for (int i = 0; i < block->size[0]; i++) {
                const double x[3] = {block->low[0] + i * block->apart, block->low[1] + j * block->apart,
                                     block->low[2] + (double)k * block->apart};
                const double depth = -solid_distance(block->solid, block->flat ? 2 : 3, x) / block->apart;
                block->inside[node_number(block, i, j, (int)k)] = (float)fmax(0, fmin(0.5 + depth, 1));
            }
}

/* The kernel at nodes around a node; the sum is 1. */
typedef struct ShareKernel {
    int reach, depth; /* nodes: along x and y, along z */
    float weight[2 * NODES + 1][2 * NODES + 1][2 * NODES + 1];
} ShareKernel;

typedef struct ShareWork {
    ShareBlock *block;
    ShareKernel kernel;
} ShareWork;

static void fill_kernel(ShareKernel *kernel, const ShareBlock *block)
{
    double sum = 0;
    kernel->reach = (int)fmin(floor(block->support / block->apart + 1e-9), NODES);
    kernel->depth = block->flat ? 0 : kernel->reach;
    for (int pass = 0; pass < 2; pass++)
        for (int c = -kernel->depth; c <= kernel->depth; c++)
            for (int b = -kernel->reach; b <= kernel->reach; b++)
                for (int a = -kernel->reach; a <= kernel->reach; a++) {
                    const double r = sqrt((double)(a * a + b * b + c * c)) * block->apart;
                    const double w = kernel_poly6(r, block->support);
                    kernel->weight[c + NODES][b + NODES][a + NODES] = (float)(w / fmax(sum, 1e-300));
                    sum += pass == 0 ? w : 0;
                }
}

/* The range of offsets from `at` on the grid. */
static void offsets(int at, int size, int reach, int *first, int *last)
{
    *first = at < reach ? -at : -reach;
    *last = size - 1 - at < reach ? size - 1 - at : reach;
}

static float share_at(const ShareWork *work, int i, int j, int k)
{
    const ShareBlock *block = work->block;
    int first[3], last[3];
    float sum = 0;
    offsets(i, block->size[0], work->kernel.reach, &first[0], &last[0]);
    offsets(j, block->size[1], work->kernel.reach, &first[1], &last[1]);
    offsets(k, block->size[2], work->kernel.depth, &first[2], &last[2]);
    for (int c = first[2]; c <= last[2]; c++)
        for (int b = first[1]; b <= last[1]; b++) {
            const float *inside = &block->inside[node_number(block, i, j + b, k + c)];
            const float *weight = &work->kernel.weight[c + NODES][b + NODES][NODES];
            for (int a = first[0]; a <= last[0]; a++)
                sum += inside[a] * weight[a];
        }
    return sum;
}

static void fill_share(void *context, size_t begin, size_t end)
{
    const ShareWork *work = context;
    const ShareBlock *block = work->block;
    for (size_t k = begin; k < end; k++)
        for (int j = 0; j < block->size[1]; j++)
            for (int i = 0; i < block->size[0]; i++)
                block->share[node_number(block, i, j, (int)k)] = share_at(work, i, j, (int)k);
}

/* Returns false if memory is short. */
static bool make_block(ShareBlock *block, float *share)
{
    const size_t rows = (size_t)block->size[2];
    ShareWork work = {.block = block};
    block->share = share;
    block->inside = calloc(count_of(block->size), sizeof *block->inside);
    if (!block->inside)
        return false;
    fill_kernel(&work.kernel, block);
    parallel_ranges(parallel_processors(), rows, 1, fill_inside, block);
    parallel_ranges(parallel_processors(), rows, 1, fill_share, &work);
    free(block->inside);
    return true;
}

/* ---- the shares of a scene ---- */

bool solid_shares_create(SolidShares *shares, Error *error)
{
    shares->program =
        program_create("solid shares", (const char *const[]){"volume/solid_shares.comp", NULL}, NULL, error);
    if (!shares->program)
        return false;
    glCreateBuffers(1, &shares->block);
    glObjectLabel(GL_BUFFER, shares->block, -1, "solid shares");
    glNamedBufferStorage(shares->block, sizeof(SolidSharesBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    return true;
}

void solid_shares_destroy(SolidShares *shares)
{
    glDeleteProgram(shares->program);
    glDeleteBuffers(2, (GLuint[]){shares->block, shares->buffer});
    free(shares->value);
    *shares = (SolidShares){0};
}

static bool is_absent(const SolidDef *solid)
{
    return solid->kind == SOLID_MESH && !solid->mesh.shape;
}

static bool up_to_date(const SolidShares *shares, const WorldDef *world, double support, bool flat)
{
    bool same = shares->value && shares->count == world->solid_count && shares->support == support &&
                shares->flat == flat;
    for (int i = 0; same && i < world->solid_count; i++)
        same = solid_mesh_same(&shares->part[i].shape, &world->solids[i]);
    return same;
}

/* If memory is short, no solid has a share, and the field is unchanged. */
static void make_shares(SolidShares *shares, const WorldDef *world, double spacing)
{
    ShareBlock block[SOLIDS_MAX];
    shares->values = 1;
    shares->count = world->solid_count;
    for (int i = 0; i < world->solid_count; i++) {
        SolidShare *part = &shares->part[i];
        *part = (SolidShare){.shape = world->solids[i]};
        block[i] = (ShareBlock){.solid = &world->solids[i], .flat = shares->flat, .support = shares->support};
        if (is_absent(&world->solids[i]))
            continue;
        place_nodes(&block[i], spacing);
        part->first = shares->values;
        part->apart = block[i].apart;
        memcpy(part->low, block[i].low, sizeof part->low);
        memcpy(part->nodes, block[i].size, sizeof part->nodes);
        shares->values += count_of(block[i].size);
    }
    free(shares->value);
    shares->value = calloc(shares->values, sizeof *shares->value);
    bool whole = shares->value != NULL;
    for (int i = 0; whole && i < world->solid_count; i++)
        whole = is_absent(&world->solids[i]) || make_block(&block[i], shares->value + shares->part[i].first);
    if (!whole)
        shares->count = 0;
}

/* From the box's frame to the solid's, to its nodes; and the place of the block in the box. */
static void place_part(SolidShare *part, bool flat, const BoxState *pose)
{
    float to_box[16], from_box[16], scaled[16] = {[15] = 1};
    camera_box_matrix(pose, to_box);
    matrix_invert_rigid(to_box, from_box);
    for (int k = 0; k < 3; k++) {
        const bool across = flat && k == 2; /* any place across a flat box is in its plane */
        double half = 0, middle = to_box[12 + k];
        scaled[5 * k] = across ? 0 : (float)(1 / part->apart);
        scaled[12 + k] = across ? 0 : (float)(-part->low[k] / part->apart);
        for (int axis = 0; axis < 3; axis++) {
            const double side = (part->nodes[axis] - 1) * part->apart;
            half += fabs((double)to_box[4 * axis + k]) * side / 2;
            middle += to_box[4 * axis + k] * (part->low[axis] + side / 2);
        }
        part->bounds[0][k] = across ? -INFINITY : middle - half;
        part->bounds[1][k] = across ? INFINITY : middle + half;
    }
    matrix_multiply(scaled, from_box, part->from_box);
}

void solid_shares_place(SolidShares *shares, const ParticleBuffers *particles, const WorldDef *world)
{
    const bool flat = frame_slab_depth(particles) > 0;
    const double support = particles->support_radius;
    if (!up_to_date(shares, world, support, flat)) {
        shares->support = support;
        shares->flat = flat;
        glDeleteBuffers(1, &shares->buffer);
        shares->buffer = 0;
        make_shares(shares, world, particles->spacing);
    }
    for (int i = 0; i < shares->count; i++) {
        BoxState pose;
        solid_pose_in(&world->solids[i], particles->time, &particles->floating[i], &pose);
        place_part(&shares->part[i], flat, &pose);
    }
}

/* The cells of a grid within reach of a part; false: none. */
static bool cells_of(const SolidShare *part, const VolumeGrid *grid, int low[3], int end[3])
{
    bool any = part->first > 0;
    for (int k = 0; k < 3; k++) {
        low[k] =
            (int)fmax(0, fmin(floor((part->bounds[0][k] - grid->corner[k]) / grid->cell), grid->size[k]));
        end[k] = (int)fmax(0, fmin(ceil((part->bounds[1][k] - grid->corner[k]) / grid->cell), grid->size[k]));
        any = any && low[k] < end[k];
    }
    return any;
}

/* Matrix from cells to nodes. */
static void from_cells(const SolidShare *part, const VolumeGrid *grid, float out[16])
{
    float cells[16] = {[15] = 1};
    for (int k = 0; k < 3; k++)
        cells[5 * k] = (float)grid->cell, cells[12 + k] = (float)grid->corner[k];
    matrix_multiply(part->from_box, cells, out);
}

/* ---- dividing on the CPU ---- */

typedef struct Division {
    const SolidShares *shares;
    const VolumeGrid *grid;
    float *field, *scalar;
    float from_cells[SOLIDS_MAX][16];
    int low[SOLIDS_MAX][3], end[SOLIDS_MAX][3];
} Division;

/* As share_at in shaders/volume/solid_shares.comp. */
static float share_between(const SolidShare *part, const float *value, const float at[3])
{
    size_t step[3] = {1, (size_t)part->nodes[0], (size_t)part->nodes[0] * (size_t)part->nodes[1]};
    float sides[3];
    const float *corner = value + part->first;
    for (int k = 0; k < 3; k++) {
        if (!(at[k] >= 0 && at[k] <= (float)(part->nodes[k] - 1)))
            return 0;
        const int low = (int)at[k];
        sides[k] = at[k] - (float)low;
        corner += (size_t)low * step[k];
        step[k] = low + 1 < part->nodes[k] ? step[k] : 0;
    }
    float sum = 0;
    for (int i = 0; i < 8; i++) {
        const float weight = ((i & 1) ? sides[0] : 1 - sides[0]) * ((i & 2) ? sides[1] : 1 - sides[1]) *
                             ((i & 4) ? sides[2] : 1 - sides[2]);
        sum += weight * corner[(i & 1 ? step[0] : 0) + (i & 2 ? step[1] : 0) + (i & 4 ? step[2] : 0)];
    }
    return sum;
}

static float taken_at(const Division *job, const int cell[3])
{
    float taken = 0;
    for (int i = 0; i < job->shares->count; i++) {
        const int *low = job->low[i], *end = job->end[i];
        const float *m = job->from_cells[i];
        float at[3];
        if (cell[0] < low[0] || cell[0] >= end[0] || cell[1] < low[1] || cell[1] >= end[1] ||
            cell[2] < low[2] || cell[2] >= end[2])
            continue;
        for (int k = 0; k < 3; k++)
            at[k] = m[12 + k] + m[k] * ((float)cell[0] + 0.5F) + m[4 + k] * ((float)cell[1] + 0.5F) +
                    m[8 + k] * ((float)cell[2] + 0.5F);
        taken += share_between(&job->shares->part[i], job->shares->value, at);
    }
    return taken;
}

/* The cells along x in which a row meets parts. */
static void row_range(const Division *job, int y, int z, int *first, int *last)
{
    *first = job->grid->size[0], *last = 0;
    for (int i = 0; i < job->shares->count; i++)
        if (y >= job->low[i][1] && y < job->end[i][1] && z >= job->low[i][2] && z < job->end[i][2]) {
            *first = job->low[i][0] < *first ? job->low[i][0] : *first;
            *last = job->end[i][0] > *last ? job->end[i][0] : *last;
        }
}

static void divide_layers(void *context, size_t begin, size_t end)
{
    const Division *job = context;
    const int *size = job->grid->size;
    for (int z = (int)begin; z < (int)end; z++)
        for (int y = 0; y < size[1]; y++) {
            const size_t row = ((size_t)z * (size_t)size[1] + (size_t)y) * (size_t)size[0];
            int first, last;
            row_range(job, y, z, &first, &last);
            for (int x = first; x < last; x++) {
                float *field = &job->field[row + (size_t)x];
                const float taken = *field > 0 ? taken_at(job, (int[]){x, y, z}) : 0;
                const float part = 1 / fmaxf(1 - taken, (float)LEAST_FREE);
                *field *= part;
                if (job->scalar)
                    job->scalar[row + (size_t)x] *= part;
            }
        }
}

void solid_shares_divide(const SolidShares *shares, const VolumeGrid *grid, float *field, float *scalar)
{
    Division job = {.shares = shares, .grid = grid, .field = field, .scalar = scalar};
    for (int i = 0; i < shares->count; i++) {
        if (!cells_of(&shares->part[i], grid, job.low[i], job.end[i]))
            job.end[i][0] = job.end[i][1] = 0;
        from_cells(&shares->part[i], grid, job.from_cells[i]);
    }
    parallel_ranges(parallel_processors(), (size_t)grid->size[2], 4, divide_layers, &job);
}

/* ---- dividing on the GPU ---- */

/* Returns the number of cells. */
static size_t fill_block(const SolidShares *shares, const VolumeGrid *grid, SolidSharesBlock *block)
{
    int end[3] = {0};
    for (int k = 0; k < 3; k++)
        block->shared_first[k] = grid->size[k];
    for (int i = 0; i < shares->count; i++) {
        const SolidShare *part = &shares->part[i];
        PlacedShare *placed = &block->shares[block->share_count];
        int part_low[3], part_end[3];
        if (!cells_of(part, grid, part_low, part_end))
            continue;
        from_cells(part, grid, placed->from_cells);
        placed->first = (int)part->first;
        for (int k = 0; k < 3; k++) {
            placed->nodes[k] = part->nodes[k];
            block->shared_first[k] =
                part_low[k] < block->shared_first[k] ? part_low[k] : block->shared_first[k];
            end[k] = part_end[k] > end[k] ? part_end[k] : end[k];
        }
        block->share_count++;
    }
    size_t all = block->share_count > 0;
    for (int k = 0; k < 3; k++) {
        block->shared_cells[k] = end[k] - block->shared_first[k];
        all *= block->share_count > 0 ? (size_t)block->shared_cells[k] : 0;
    }
    block->least_free = (float)LEAST_FREE;
    return all;
}

static void send_values(SolidShares *shares)
{
    glCreateBuffers(1, &shares->buffer);
    glObjectLabel(GL_BUFFER, shares->buffer, -1, "solid share values");
    glNamedBufferStorage(shares->buffer, (GLsizeiptr)(shares->values * sizeof *shares->value), shares->value,
                         0);
}

static void divide(GLuint texture, size_t cells)
{
    glBindImageTexture(FIELD_IMAGE, texture, 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32F);
    work_run(cells);
}

void solid_shares_apply(SolidShares *shares, const Volume *volume)
{
    SolidSharesBlock block = {.share_count = 0};
    const size_t cells = volume->field ? fill_block(shares, &volume->grid, &block) : 0;
    if (cells == 0)
        return;
    if (!shares->buffer)
        send_values(shares);
    glNamedBufferSubData(shares->block, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, SOLID_SHARES_BLOCK, shares->block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SOLID_SHARES_STORAGE, shares->buffer);
    glUseProgram(shares->program);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    divide(volume->field, cells);
    if (volume->scalar)
        divide(volume->scalar, cells);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT |
                    GL_FRAMEBUFFER_BARRIER_BIT); /* the next picture draws into the field */
}
