/* The volume as by K. Iwasaki, Y. Dobashi, F. Yoshimoto, T. Nishita, "Real-time rendering of point based
   water surfaces", 2006, by the account in section IV.A of "SPH coupled with volume rendering" (SIBGRAPI
   2010). For measurements: `planes` draws the same and leaves all on the GPU.

   1. clustering, on the CPU: the particles that cut the four planes of each pass
   2. for each pass: its particles are sent and drawn, and the framebuffer of four planes is read back
   3. the volume is sent to the GPU */
#include "render/particles/particles.h"
#include "render/views/volume/volume_private.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PLANES = 4 }; /* of a pass: red, green, blue, alpha */

typedef struct Iwasaki {
    bool scalar;
    GLuint program, framebuffer, vertex_array, elements;
    GLuint planes[2];                /* textures of a pass */
    int size[3];                     /* of the volume, cells */
    size_t particles, members, sent; /* capacities */
    float *position;                 /* x y z and volume of each particle */
    uint32_t *begin;                 /* first member of each pass, and the end */
    uint32_t *member;                /* particles of the passes, a pass after the other */
    float *pixels;                   /* of a pass, PLANES a cell */
    float *values[2];                /* of the volume, and of the scalar's */
} Iwasaki;

static void iwasaki_destroy(void *state)
{
    Iwasaki *own = state;
    glDeleteProgram(own->program);
    glDeleteFramebuffers(1, &own->framebuffer);
    glDeleteVertexArrays(1, &own->vertex_array);
    glDeleteBuffers(1, &own->elements);
    glDeleteTextures(2, own->planes);
    free(own->position);
    free(own->begin);
    free(own->member);
    free(own->pixels);
    free(own->values[0]);
    free(own->values[1]);
    free(own);
}

static void *iwasaki_create(VolumeMethod method, bool scalar, Error *error)
{
    static const char *const stages[] = {"volume/voxelize.vert", "volume/voxelize.frag", NULL};
    static const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    Iwasaki *own = calloc(1, sizeof *own);
    (void)method;
    if (!own) {
        error_set(error, "out of memory for the voxelizer");
        return NULL;
    }
    own->scalar = scalar;
    glCreateVertexArrays(1, &own->vertex_array);
    glCreateFramebuffers(1, &own->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, own->framebuffer, -1, "volume");
    glNamedFramebufferDrawBuffers(own->framebuffer, scalar ? 2 : 1, buffers);
    own->program =
        program_create("voxelize", stages,
                       scalar ? "#define SCALAR 1\n#define PASS 1\n#define SLICES 4\n#define PACKED 1\n"
                              : "#define PASS 1\n#define SLICES 4\n#define PACKED 1\n",
                       error);
    if (own->program)
        return own;
    iwasaki_destroy(own);
    return NULL;
}

static bool iwasaki_fits(const VolumeGrid *grid, double radius, Error *error)
{
    return voxelize_points.fits(grid, radius, error);
}

static int pass_count(const int size[3])
{
    return (size[2] + PLANES - 1) / PLANES;
}

static bool remake(void **values, size_t bytes)
{
    free(*values);
    *values = malloc(bytes > 0 ? bytes : 1);
    return *values != NULL;
}

/* Makes room for a volume of this size. */
static bool iwasaki_reserve(void *state, const VolumeGrid *grid, Error *error)
{
    Iwasaki *own = state;
    const size_t plane = (size_t)grid->size[0] * (size_t)grid->size[1];
    if (own->values[0] && memcmp(own->size, grid->size, sizeof own->size) == 0)
        return true;
    memset(own->size, 0, sizeof own->size);
    glDeleteTextures(2, own->planes);
    own->planes[0] = own->planes[1] = 0;
    bool made = remake((void **)&own->pixels, PLANES * plane * sizeof *own->pixels) &&
                remake((void **)&own->begin, ((size_t)pass_count(grid->size) + 1) * sizeof *own->begin);
    for (int i = 0; made && i <= (int)own->scalar; i++) {
        own->planes[i] =
            volume_texture((const int[3]){grid->size[0], grid->size[1], 1}, GL_RGBA32F, "four planes");
        made = own->planes[i] && remake((void **)&own->values[i], volume_grid_cells(grid) * sizeof(float));
    }
    if (!made)
        return error_set(error, "no memory for the planes of a volume; take larger cells");
    memcpy(own->size, grid->size, sizeof own->size);
    for (int i = 0; i <= (int)own->scalar; i++)
        glNamedFramebufferTextureLayer(own->framebuffer, GL_COLOR_ATTACHMENT0 + (GLenum)i, own->planes[i], 0,
                                       0);
    return true;
}

static bool read_positions(Iwasaki *own, const VoxelizeJob *job, Error *error)
{
    const size_t count = job->particles->count;
    if (count > own->particles || !own->position) {
        own->particles = 0;
        if (!remake((void **)&own->position, 4 * count * sizeof *own->position))
            return error_set(error, "no memory to read %zu particles", count);
        own->particles = count;
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); /* a GPU backend may have written the buffers */
    return count == 0 || voxelize_read(&job->particles->position, count, 4, own->position) ||
           error_set(error, "no memory to read %zu particles", count);
}

/* The passes whose planes the particle cuts; false: none. */
static bool passes_of(const float at[4], const VoxelizeJob *job, int *first, int *last)
{
    static const double SLACK = 1e-3; /* cells: the shader rounds otherwise */
    const VolumeGrid *grid = &job->volume->grid;
    if (!voxelize_counts(at, job))
        return false;
    const double z = ((double)at[2] - grid->corner[2]) / grid->cell - 0.5, reach = job->radius + SLACK;
    const double low = fmax(ceil(z - reach), 0), high = fmin(floor(z + reach), grid->size[2] - 1);
    *first = (int)low / PLANES;
    *last = (int)high / PLANES;
    return low <= high;
}

/* Lists the particles of each pass, by counting. */
static bool cluster(Iwasaki *own, const VoxelizeJob *job, Error *error)
{
    const int passes = pass_count(own->size);
    int first, last;
    memset(own->begin, 0, ((size_t)passes + 1) * sizeof *own->begin);
    for (size_t i = 0; i < job->particles->count; i++)
        if (passes_of(own->position + 4 * i, job, &first, &last))
            for (int pass = first; pass <= last; pass++)
                own->begin[pass + 1]++;
    for (int pass = 0; pass < passes; pass++)
        own->begin[pass + 1] += own->begin[pass];
    const size_t members = own->begin[passes];
    if (members > own->members || !own->member) {
        own->members = 0;
        if (!remake((void **)&own->member, members * sizeof *own->member))
            return error_set(error, "no memory for the particles of %d passes", passes);
        own->members = members;
    }
    for (size_t i = job->particles->count;
         i-- > 0;) /* each pass fills from its end, which becomes its begin */
        if (passes_of(own->position + 4 * i, job, &first, &last))
            for (int pass = first; pass <= last; pass++)
                own->member[--own->begin[pass + 1]] = (uint32_t)i;
    memmove(own->begin, own->begin + 1, (size_t)passes * sizeof *own->begin);
    own->begin[passes] = (uint32_t)members;
    return true;
}

/* Sends the particles of a pass. */
static void send_members(Iwasaki *own, int pass)
{
    const size_t count = own->begin[pass + 1] - own->begin[pass];
    if (count > own->sent || !own->elements) {
        glDeleteBuffers(1, &own->elements);
        glCreateBuffers(1, &own->elements);
        glObjectLabel(GL_BUFFER, own->elements, -1, "particles of a pass");
        own->sent = count + count / 4 + 1;
        glNamedBufferStorage(own->elements, (GLsizeiptr)(own->sent * sizeof *own->member), NULL,
                             GL_DYNAMIC_STORAGE_BIT);
        glVertexArrayElementBuffer(own->vertex_array, own->elements);
    }
    glNamedBufferSubData(own->elements, 0, (GLsizeiptr)(count * sizeof *own->member),
                         own->member + own->begin[pass]);
}

static void begin(const Iwasaki *own, const VoxelizeJob *job)
{
    glBindFramebuffer(GL_FRAMEBUFFER, own->framebuffer);
    glViewport(0, 0, own->size[0], own->size[1]);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(own->program);
    particle_bind(own->program, job->particles, job->carried);
    glBindVertexArray(own->vertex_array);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

/* Reads the planes of a pass back, and puts them into the volume. */
static void read_back(Iwasaki *own, int pass, int which)
{
    const size_t plane = (size_t)own->size[0] * (size_t)own->size[1];
    glReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)which);
    glReadPixels(0, 0, own->size[0], own->size[1], GL_RGBA, GL_FLOAT, own->pixels);
    for (int k = 0; k < PLANES && pass * PLANES + k < own->size[2]; k++) {
        float *to = own->values[which] + (size_t)(pass * PLANES + k) * plane;
        for (size_t i = 0; i < plane; i++)
            to[i] = own->pixels[PLANES * i + (size_t)k];
    }
}

static void run_passes(Iwasaki *own)
{
    static const GLfloat none[4] = {0};
    for (int pass = 0; pass < pass_count(own->size); pass++) {
        const uint32_t count = own->begin[pass + 1] - own->begin[pass];
        for (int i = 0; i <= (int)own->scalar; i++)
            glClearNamedFramebufferfv(own->framebuffer, GL_COLOR, i, none);
        if (count > 0) {
            send_members(own, pass);
            glUniform1i(PASS_SLICE_AT, pass * PLANES);
            glDrawElements(GL_POINTS, (GLsizei)count, GL_UNSIGNED_INT, NULL);
        }
        for (int i = 0; i <= (int)own->scalar; i++)
            read_back(own, pass, i);
    }
}

static bool iwasaki_run(void *state, const VoxelizeJob *job, Error *error)
{
    Iwasaki *own = state;
    const GLuint volume[2] = {job->volume->field, job->volume->scalar};
    if (!iwasaki_reserve(own, &job->volume->grid, error) || !read_positions(own, job, error) ||
        !cluster(own, job, error))
        return false;
    begin(own, job);
    run_passes(own);
    for (int i = 0; i <= (int)own->scalar; i++)
        glTextureSubImage3D(volume[i], 0, 0, 0, 0, own->size[0], own->size[1], own->size[2], GL_RED, GL_FLOAT,
                            own->values[i]);
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return true;
}

const VoxelizeMethod voxelize_iwasaki = {
    .create = iwasaki_create,
    .destroy = iwasaki_destroy,
    .fits = iwasaki_fits,
    .reserve = iwasaki_reserve,
    .run = iwasaki_run,
};
