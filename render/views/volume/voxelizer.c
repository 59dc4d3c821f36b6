/* Volumes: grids, mirror images at walls, fluid numbers, and runs of a voxelization method. */
#include "render/frame/frame.h"
#include "render/particles/particles.h"
#include "render/views/volume/volume_private.h"
#include "shaders/volume/volume_bindings.h"
#include "shaders/volume/volume_block.h"
#include "sim/gpu/gl.h"
#include "sim/kernel/kernel.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 4096, CROP = 8 };
static const double CELLS_MAX = 2147483648.0;

static double longest(const double size[3])
{
    return fmax(size[0], fmax(size[1], size[2]));
}

/* Requested side of a cell, m. */
static double asked_side(const VolumeDef *def, const ParticleBuffers *particles)
{
    const double side = longest(particles->box_size) / def->cells;
    if (def->cell > 0)
        return def->cell * particles->spacing;
    if (def->cells_least > 0)
        return fmin(fmax(side, VOLUME_FINEST * particles->spacing),
                    longest(particles->box_size) / def->cells_least);
    return side;
}

bool volume_grid_for(const VolumeDef *def, const ParticleBuffers *particles, VolumeGrid *grid, Error *error)
{
    const double *box = particles->box_size, margin = particles->support_radius;
    const double asked = asked_side(def, particles);
    const double cell = margin > 0 ? fmin(asked, margin) : asked; /* wider cells could lose fluid between
                                                                     samples */
    double all = 1;
    *grid = (VolumeGrid){.cell = cell};
    for (int k = 0; k < 3; k++) {
        const double cells = ceil((box[k] + 2 * margin) / cell - 1e-6);
        if (!(cells <= SIDE_MAX))
            return error_set(
                error,
                "a volume of %.0f cells along %c; at most %d will do: take fewer view.volume.cells, or "
                "a larger view.volume.cell",
                cells, "xyz"[k], SIDE_MAX);
        grid->size[k] = (int)fmax(cells, 1);
        grid->corner[k] = (k == 1 ? box[k] / 2 : 0) - grid->size[k] * cell / 2;
        all *= grid->size[k];
    }
    return all <= CELLS_MAX ||
           error_set(
               error,
               "a volume of %d x %d x %d cells; at most %.0f of them will do: take fewer view.volume.cells, "
               "or a larger view.volume.cell",
               grid->size[0], grid->size[1], grid->size[2], CELLS_MAX);
}

/* The cell of a position, clamped to the grid. */
static int cell_of(const VolumeGrid *grid, int axis, double at)
{
    const double cell = floor((at - grid->corner[axis]) / grid->cell);
    return (int)fmax(0, fmin(cell, grid->size[axis] - 1)); /* 0 for NaN */
}

void volume_grid_crop(const VolumeGrid *whole, const double low[3], const double high[3], double support,
                      VolumeGrid *out)
{
    *out = *whole;
    for (int k = 0; k < 3; k++) {
        const bool any = low[0] <= high[0];
        const int first = any ? cell_of(whole, k, low[k] - support) / CROP * CROP : 0;
        const int end = any ? (cell_of(whole, k, high[k] + support) / CROP + 1) * CROP : 1;
        out->size[k] = (end < whole->size[k] ? end : whole->size[k]) - first;
        out->corner[k] = whole->corner[k] + first * whole->cell;
    }
}

enum { MIRROR_GROUP = 64 };

/* A side of an axis. */
typedef struct MirrorWall {
    int axis, inwards, cells;
    double place; /* cells from the volume's corner */
} MirrorWall;

bool volume_walls_create(VolumeWalls *walls, Error *error)
{
    walls->program =
        program_create("volume walls", (const char *const[]){"volume/walls.comp", NULL}, NULL, error);
    return walls->program != 0;
}

void volume_walls_destroy(VolumeWalls *walls)
{
    glDeleteProgram(walls->program);
    *walls = (VolumeWalls){0};
}

/* Adds the field behind the wall, mirrored, to the cells in front. */
static void add_images(const MirrorWall *wall, const Volume *volume)
{
    const int *size = volume->grid.size, axis = wall->axis;
    const int first = wall->inwards > 0 ? (int)ceil(wall->place - 0.5) : (int)floor(wall->place - 0.5);
    const size_t all =
        (size_t)size[0] * (size_t)size[1] * (size_t)size[2] / (size_t)size[axis] * (size_t)wall->cells;
    glUniform1i(WALL_AXIS_AT, axis);
    glUniform1f(WALL_PLACE_AT, (GLfloat)wall->place);
    glUniform3i(WALL_CELLS_AT, first, wall->cells, wall->inwards);
    work_dispatch((all + MIRROR_GROUP - 1) / MIRROR_GROUP);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

static void mirror_at_wall(const Volume *volume, unsigned texture, int axis, double low, double high)
{
    const VolumeGrid *grid = &volume->grid;
    const double between = ceil((high - low) / grid->cell), reach = ceil(volume->support / grid->cell);
    const int cells = (int)fmin(between, reach);
    glBindImageTexture(FIELD_IMAGE, texture, 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32F);
    add_images(&(MirrorWall){axis, 1, cells, (low - grid->corner[axis]) / grid->cell}, volume);
    add_images(&(MirrorWall){axis, -1, cells, (high - grid->corner[axis]) / grid->cell}, volume);
}

void volume_walls_apply(const VolumeWalls *walls, const ParticleBuffers *particles, const bool periodic[3],
                        Volume *volume)
{
    const bool flat = frame_slab_depth(particles) > 0;
    if (!volume->field)
        return;
    glUseProgram(walls->program);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    for (int axis = 0; axis < 3; axis++) {
        const double size = particles->box_size[axis], low = axis == 1 ? 0 : -size / 2;
        volume->walled[axis] = !periodic[axis] && !(flat && axis == 2);
        if (!volume->walled[axis])
            continue;
        mirror_at_wall(volume, volume->field, axis, low, low + size);
        if (volume->scalar)
            mirror_at_wall(volume, volume->scalar, axis, low, low + size);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                    GL_FRAMEBUFFER_BARRIER_BIT); /* the next picture draws into the field */
}

/* Grid, textures and constants of a volume; a VoxelizeMethod computes the values. */

struct Voxelizer {
    VolumeMethod method;
    bool scalar;
    const VoxelizeMethod *by;
    void *state;          /* state of the method */
    GLuint block, bounds; /* buffers */
    GLuint find_bounds;   /* program, made when fluid bounds are first wanted */
    SolidShares *shares;
    Volume volume;
};

static const double PI = 3.14159265358979323846;

static const VoxelizeMethod *const methods[] = {
    [VOLUME_GEOMETRY] = &voxelize_points, [VOLUME_LAYERS] = &voxelize_points,
    [VOLUME_PLANES] = &voxelize_points,   [VOLUME_SCATTER] = &voxelize_compute,
    [VOLUME_GATHER] = &voxelize_compute,  [VOLUME_SLABS] = &voxelize_slabs,
    [VOLUME_IWASAKI] = &voxelize_iwasaki, [VOLUME_DIRECT] = &voxelize_compute};

/* Software driver: the driver's memory is the CPU's, and sums on the CPU are by far the fastest. Hardware: a
   geometry shader (the paper's method) sends each particle's slices through a few units of a GPU only. */
static VolumeMethod choose(VolumeMethod method)
{
    if (method != VOLUME_AUTO)
        return method;
    return gl_renderer_is_software() ? VOLUME_SLABS : VOLUME_GATHER;
}

static GLuint create_buffer(size_t size, const char *label)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, label);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, NULL, GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}

Voxelizer *voxelizer_create(VolumeMethod method, bool scalar, Error *error)
{
    Voxelizer *voxelizer = calloc(1, sizeof *voxelizer);
    if (!voxelizer) {
        error_set(error, "out of memory for the voxelizer");
        return NULL;
    }
    voxelizer->method = choose(method);
    voxelizer->scalar = scalar;
    voxelizer->by = methods[voxelizer->method];
    voxelizer->block = create_buffer(sizeof(VolumeBlock), "volume");
    voxelizer->bounds = create_buffer(6 * sizeof(GLuint), "volume bounds");
    voxelizer->state = voxelizer->by->create(voxelizer->method, scalar, error);
    if (voxelizer->state)
        return voxelizer;
    voxelizer_destroy(voxelizer);
    return NULL;
}

static void delete_textures(Volume *volume)
{
    glDeleteTextures(2, (GLuint[]){volume->field, volume->scalar});
    *volume = (Volume){0};
}

void voxelizer_destroy(Voxelizer *voxelizer)
{
    if (!voxelizer)
        return;
    if (voxelizer->state)
        voxelizer->by->destroy(voxelizer->state);
    delete_textures(&voxelizer->volume);
    glDeleteBuffers(2, (GLuint[]){voxelizer->block, voxelizer->bounds});
    glDeleteProgram(voxelizer->find_bounds);
    free(voxelizer);
}

const char *voxelizer_defines(const Voxelizer *voxelizer)
{
    static const char *const lines[] = {"", "#define SCALAR 1\n", "#define FIELD_DIRECT 1\n",
                                        "#define FIELD_DIRECT 1\n#define SCALAR 1\n"};
    return lines[2 * (voxelizer->method == VOLUME_DIRECT) + voxelizer->scalar];
}

static double bytes_of(const VolumeGrid *grid, bool scalar)
{
    return 4.0 * grid->size[0] * grid->size[1] * grid->size[2] * (scalar ? 2 : 1);
}

static bool driver_takes(const VolumeGrid *grid)
{
    GLint width = 0;
    glTexImage3D(GL_PROXY_TEXTURE_3D, 0, GL_R32F, grid->size[0], grid->size[1], grid->size[2], 0, GL_RED,
                 GL_FLOAT, NULL);
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
    return width == grid->size[0];
}

bool voxelizer_fits(const Voxelizer *voxelizer, const VolumeGrid *grid, double support, Error *error)
{
    const double bytes = bytes_of(grid, voxelizer->scalar);
    if (voxelizer->method == VOLUME_DIRECT)
        return true;
    const double needed = 2.5 * bytes; /* planes and slabs need the same amount again */
    if (!driver_takes(grid) || needed > gl_memory())
        return error_set(
            error,
            "a volume of %d x %d x %d cells (%.0f MB) is more than this driver has room for: take fewer "
            "view.volume.cells, or a larger view.volume.cell",
            grid->size[0], grid->size[1], grid->size[2], bytes / 1e6);
    return !voxelizer->by->fits || voxelizer->by->fits(grid, support / grid->cell, error);
}

static bool follow_grid(Voxelizer *voxelizer, const VolumeGrid *grid, Error *error)
{
    Volume *volume = &voxelizer->volume;
    if (voxelizer->method == VOLUME_DIRECT)
        return true;
    if (volume->field && memcmp(volume->grid.size, grid->size, sizeof grid->size) == 0)
        return true;
    delete_textures(volume);
    volume->field = volume_texture(grid->size, GL_R32F, "volume field");
    if (volume->field && voxelizer->scalar)
        volume->scalar = volume_texture(grid->size, GL_R32F, "volume scalar");
    volume->grid = *grid;
    if (volume->field && (volume->scalar || !voxelizer->scalar))
        return true;
    delete_textures(volume);
    return error_set(error, "the GPU has no memory for a volume of %d x %d x %d cells; take larger cells",
                     grid->size[0], grid->size[1], grid->size[2]);
}

static void fill_block(const Voxelizer *voxelizer, const VoxelizeJob *job, const VolumeGrid *grid)
{
    VolumeBlock block = {.cells_per_m = (float)(1 / grid->cell),
                         .kernel_radius = (float)job->radius,
                         .radius2_inverse = (float)(1 / (job->radius * job->radius)),
                         .kernel_peak = (float)job->amplitude,
                         .particle_count = (GLuint)job->particles->count};
    for (int k = 0; k < 3; k++) {
        block.volume_corner[k] = (float)grid->corner[k];
        block.volume_low[k] = (float)job->low[k];
        block.volume_high[k] = (float)job->high[k];
        block.volume_size[k] = grid->size[k];
    }
    block.list_scale = (float)cell_lists_size(grid, job->radius, block.list_size);
    glNamedBufferSubData(voxelizer->block, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, VOLUME_BLOCK, voxelizer->block);
}

/* Decodes the numbers of shaders/volume/volume_bounds.comp. */
static double ordered(GLuint value)
{
    const GLuint bits = value & 0x80000000U ? value & 0x7fffffffU : ~value;
    GLfloat number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static bool prepare_bounds(Voxelizer *voxelizer, Error *error)
{
    static const char *const stages[] = {"volume/volume_bounds.comp", NULL};
    if (!voxelizer->find_bounds)
        voxelizer->find_bounds = program_create("volume bounds", stages, NULL, error);
    return voxelizer->find_bounds != 0;
}

bool voxelizer_prepare(Voxelizer *voxelizer, const VolumeDef *def, const VolumeGrid *whole, Error *error)
{
    if (def->bounds == VOLUME_FLUID)
        return prepare_bounds(voxelizer, error);
    return follow_grid(voxelizer, whole, error) &&
           (!voxelizer->by->reserve || voxelizer->by->reserve(voxelizer->state, whole, error));
}

/* Waits for the GPU: the CPU needs the grid's size. */
static void find_bounds(const Voxelizer *voxelizer, const VoxelizeJob *job, GLuint found[6])
{
    enum { GROUP = 256, GROUPS_MOST = 256 };
    const GLsizeiptr size = 6 * sizeof *found;
    const size_t groups = (job->particles->count + GROUP - 1) / GROUP;
    glNamedBufferSubData(voxelizer->bounds, 0, size, found);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BOUNDS_STORAGE, voxelizer->bounds);
    glUseProgram(voxelizer->find_bounds);
    particle_bind(voxelizer->find_bounds, job->particles, job->carried);
    glDispatchCompute((GLuint)(groups < GROUPS_MOST ? groups : GROUPS_MOST), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(voxelizer->bounds, 0, size, found);
}

static void crop_to_fluid(const Voxelizer *voxelizer, const VoxelizeJob *job, const VolumeGrid *whole,
                          VolumeGrid *grid)
{
    GLuint found[6] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, 0, 0, 0};
    double low[3], high[3];
    if (job->particles->count > 0)
        find_bounds(voxelizer, job, found);
    for (int k = 0; k < 3; k++) {
        low[k] = ordered(found[k]);
        high[k] = ordered(found[3 + k]);
    }
    volume_grid_crop(whole, low, high, job->particles->support_radius, grid);
}

/* A two-dimensional scene is as deep as one particle layer; the volumes are areas, and the kernel is the
   plane's. */
static bool is_flat(const ParticleBuffers *particles)
{
    return fabs(particles->box_size[2] - particles->spacing) < 1e-6 * particles->spacing;
}

static VoxelizeJob make_job(const Voxelizer *voxelizer, const ParticleBuffers *particles, Scalar carried,
                            const VolumeGrid *whole)
{
    const double h = particles->support_radius;
    VoxelizeJob job = {.particles = particles,
                       .carried = carried,
                       .scalar = voxelizer->scalar,
                       .radius = h / whole->cell,
                       .shares = voxelizer->shares,
                       .amplitude = is_flat(particles) ? 4 / (PI * h * h) : kernel_poly6(0, h),
                       .volume = &voxelizer->volume};
    for (int k = 0; k < 3; k++) {
        job.low[k] = whole->corner[k];
        job.high[k] = whole->corner[k] + whole->size[k] * whole->cell;
    }
    return job;
}

static bool make_volume(Voxelizer *voxelizer, const VolumeDef *def, const VoxelizeJob *job,
                        const VolumeGrid *whole, Error *error)
{
    VolumeGrid grid = *whole;
    fill_block(voxelizer, job, &grid);
    if (def->bounds == VOLUME_FLUID) {
        crop_to_fluid(voxelizer, job, whole, &grid);
        fill_block(voxelizer, job, &grid);
    }
    if (!follow_grid(voxelizer, &grid, error))
        return false;
    voxelizer->volume.grid = grid;
    voxelizer->volume.support = job->particles->support_radius;
    if (!voxelizer->by->run(voxelizer->state, job, error))
        return false;
    if (job->shares && !voxelizer->by->divides)
        solid_shares_apply(job->shares, &voxelizer->volume);
    return true;
}

void voxelizer_set_solids(Voxelizer *voxelizer, SolidShares *shares)
{
    voxelizer->shares = shares;
}

bool voxelizer_run(Voxelizer *voxelizer, const VolumeDef *def, const ParticleBuffers *particles,
                   Scalar carried, Volume *out, Error *error)
{
    VolumeGrid whole;
    *out = (Volume){0};
    if (!volume_grid_for(def, particles, &whole, error) ||
        (def->bounds == VOLUME_FLUID && !prepare_bounds(voxelizer, error)))
        return false;
    const VoxelizeJob job = make_job(voxelizer, particles, carried, &whole);
    if (!make_volume(voxelizer, def, &job, &whole, error))
        return false;
    *out = voxelizer->volume;
    return true;
}

void voxelizer_bind(const Voxelizer *voxelizer)
{
    glBindBufferBase(GL_UNIFORM_BUFFER, VOLUME_BLOCK, voxelizer->block);
    glBindTextures(FIELD_UNIT, 2, (GLuint[]){voxelizer->volume.field, voxelizer->volume.scalar});
    if (voxelizer->method == VOLUME_DIRECT)
        voxelize_compute_bind(voxelizer->state);
}
