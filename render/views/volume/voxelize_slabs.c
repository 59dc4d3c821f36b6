/* Voxelization on the CPU by sim/mesh.h: for software drivers, which use the CPU's memory. */
#include "render/views/volume/volume_private.h"
#include "sim/base/base.h"
#include "sim/kernel/kernel.h"
#include "sim/mesh.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells that may be nonzero; empty if end <= low. */
typedef struct SlabRegion {
    int low[3], end[3];
} SlabRegion;

typedef struct Slabs {
    bool scalar;
    size_t capacity;         /* capacity in particles */
    float *position, *value; /* particles inside the grid: `value` is the scalar */
    FieldSlabs slabs;
    size_t cells;            /* capacity in cells */
    float *field, *weighted; /* values of the grid; `weighted` is NULL without a scalar */
    SlabRegion sent;         /* region sent to the textures */
    int sent_size[3];        /* size of the textures, which are made again for a new size */
} Slabs;

static void slabs_destroy(void *state)
{
    Slabs *own = state;
    field_slabs_free(&own->slabs);
    free(own->position);
    free(own->value);
    free(own->field);
    free(own->weighted);
    free(own);
}

static void *slabs_create(VolumeMethod method, bool scalar, Error *error)
{
    Slabs *own = calloc(1, sizeof *own);
    (void)method;
    if (own)
        own->scalar = scalar;
    else
        error_set(error, "out of memory for the voxelizer");
    return own;
}

static bool remake(float **values, size_t count)
{
    free(*values);
    *values = malloc(count * sizeof **values);
    return *values != NULL;
}

static bool reserve_cells(void *state, const VolumeGrid *grid, Error *error)
{
    Slabs *own = state;
    const size_t cells = volume_grid_cells(grid);
    if (cells == own->cells)
        return true;
    own->cells = 0;
    if (!remake(&own->field, cells) || (own->scalar && !remake(&own->weighted, cells)))
        return error_set(error, "no memory for the sums of a volume; take larger cells");
    own->cells = cells;
    return true;
}

static bool reserve(Slabs *own, size_t count, const VolumeGrid *grid, Error *error)
{
    if (count > own->capacity || !own->position) {
        own->capacity = 0;
        if (!remake(&own->position, 4 * count + 4) || (own->scalar && !remake(&own->value, count + 1)))
            return error_set(error, "no memory to read %zu particles", count);
        own->capacity = count;
    }
    return reserve_cells(own, grid, error);
}

bool voxelize_read(const ParticleAttribute *from, size_t count, size_t words, float *to)
{
    const size_t stride = from->stride / sizeof(float);
    float *raw = stride == words ? to : malloc(count * from->stride);
    if (!raw)
        return false;
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * from->stride), raw);
    if (raw == to)
        return true;
    for (size_t i = 0; i < count; i++)
        memcpy(to + words * i, raw + stride * i, words * sizeof(float));
    free(raw);
    return true;
}

bool voxelize_counts(const float at[4], const VoxelizeJob *job)
{
    bool inside = at[3] > 0 && at[3] < 1e30F;
    for (int k = 0; k < 3; k++)
        inside = inside && at[k] >= (float)job->low[k] && at[k] <= (float)job->high[k]; /* false for NaN */
    return inside;
}

static bool read_particles(Slabs *own, const VoxelizeJob *job, FieldParticles *out, Error *error)
{
    const ParticleBuffers *particles = job->particles;
    const ParticleAttribute *scalar = &particles->scalar[job->carried];
    const size_t all = particles->count;
    const bool carried = own->scalar && scalar->buffer;
    const float scale = (float)(job->amplitude / kernel_poly6(0, particles->support_radius)); /* 1 in three
                                                                                                 dimensions */
    size_t count = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); /* a GPU backend may have written the buffers */
    if (all > 0 && !(voxelize_read(&particles->position, all, 4, own->position) &&
                     (!carried || voxelize_read(scalar, all, 1, own->value))))
        return error_set(error, "no memory to read %zu particles", all);
    for (size_t i = 0; i < all; i++) {
        if (!voxelize_counts(own->position + 4 * i, job))
            continue;
        memmove(own->position + 4 * count, own->position + 4 * i, 4 * sizeof(float));
        own->position[4 * count + 3] *= scale;
        if (own->scalar)
            own->value[count] = carried && fabsf(own->value[i]) < 1e30F ? own->value[i] : 0;
        count++;
    }
    *out = (FieldParticles){count, own->position, own->value, particles->support_radius};
    return true;
}

static SlabRegion region_of(const FieldParticles *particles, const VolumeGrid *grid)
{
    SlabRegion region = {0};
    double low[3], high[3];
    if (!field_bounds(particles, low, high))
        return region;
    for (int k = 0; k < 3; k++) {
        const double first = floor((low[k] - particles->support - grid->corner[k]) / grid->cell),
                     end = ceil((high[k] + particles->support - grid->corner[k]) / grid->cell);
        region.low[k] = (int)fmax(0, fmin(first, grid->size[k]));
        region.end[k] = (int)fmax(0, fmin(end, grid->size[k]));
    }
    return region;
}

static bool is_empty(const SlabRegion *region)
{
    return region->end[0] <= region->low[0] || region->end[1] <= region->low[1] ||
           region->end[2] <= region->low[2];
}

static SlabRegion both(const SlabRegion *a, const SlabRegion *b)
{
    SlabRegion all = *a;
    if (is_empty(a) || is_empty(b))
        return is_empty(a) ? *b : *a;
    for (int k = 0; k < 3; k++) {
        all.low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
        all.end[k] = a->end[k] > b->end[k] ? a->end[k] : b->end[k];
    }
    return all;
}

static void send(const float *values, GLuint texture, const int size[3], const SlabRegion *region)
{
    const int *low = region->low, *end = region->end;
    glTextureSubImage3D(
        texture, 0, low[0], low[1], low[2], end[0] - low[0], end[1] - low[1], end[2] - low[2], GL_RED,
        GL_FLOAT, values + ((size_t)low[2] * (size_t)size[1] + (size_t)low[1]) * (size_t)size[0] + low[0]);
}

/* Cells sent before that are empty now are 0 and must be sent too; a new texture holds nothing. */
static void send_changes(Slabs *own, const Volume *volume, const SlabRegion *now)
{
    const bool fresh = memcmp(own->sent_size, volume->grid.size, sizeof own->sent_size) != 0;
    const SlabRegion before = fresh ? (SlabRegion){0} : own->sent, changed = both(&before, now);
    if (!is_empty(&changed)) {
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, volume->grid.size[0]);
        glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, volume->grid.size[1]);
        send(own->field, volume->field, volume->grid.size, &changed);
        if (own->scalar)
            send(own->weighted, volume->scalar, volume->grid.size, &changed);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
        glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
    }
    own->sent = *now;
    memcpy(own->sent_size, volume->grid.size, sizeof own->sent_size);
}

static bool slabs_run(void *state, const VoxelizeJob *job, Error *error)
{
    Slabs *own = state;
    const VolumeGrid *grid = &job->volume->grid;
    FieldParticles particles = {0};
    if (!reserve(own, job->particles->count, grid, error) || !read_particles(own, job, &particles, error) ||
        !field_sum(&particles, grid, parallel_processors(), &own->slabs, own->field, own->weighted, error))
        return false;
    if (job->shares)
        solid_shares_divide(job->shares, grid, own->field, own->weighted);
    const SlabRegion now = region_of(&particles, grid);
    send_changes(own, job->volume, &now);
    return true;
}

const VoxelizeMethod voxelize_slabs = {
    .create = slabs_create,
    .destroy = slabs_destroy,
    .reserve = reserve_cells,
    .run = slabs_run,
    .divides = true,
};
