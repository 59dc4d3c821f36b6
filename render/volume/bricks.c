#include "render/volume/bricks.h"

#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool bricks_create(Bricks *bricks, Error *error)
{
    *bricks = (Bricks){0};
    quad_indices_create(&bricks->quads);
    glCreateBuffers(1, &bricks->commands);
    glObjectLabel(GL_BUFFER, bricks->commands, -1, "brick commands");
    glNamedBufferStorage(bricks->commands, 5 * sizeof(GLuint), NULL, GL_DYNAMIC_STORAGE_BIT);
    bricks->greatest = program_create(
        "bricks greatest", (const char *const[]){"volume/bricks_greatest.comp", NULL}, NULL, error);
    if (bricks->greatest)
        bricks->list = program_create("bricks list", (const char *const[]){"volume/bricks_list.comp", NULL},
                                      NULL, error);
    if (bricks->list)
        bricks->faces =
            program_create_pair("bricks faces", "volume/bricks_faces.vert", "render/depth_only.frag", error);
    return bricks->faces != 0;
}

void bricks_destroy(Bricks *bricks)
{
    glDeleteProgram(bricks->greatest);
    glDeleteProgram(bricks->list);
    glDeleteProgram(bricks->faces);
    glDeleteTextures(1, &bricks->map);
    glDeleteBuffers(2, (GLuint[]){bricks->found, bricks->commands});
    quad_indices_destroy(&bricks->quads);
    *bricks = (Bricks){0};
}

/* n voxels have n - 1 intervals between. */
int bricks_of(const VolumeGrid *grid, int count[3])
{
    int longest = 0;
    for (int k = 0; k < 3; k++)
        longest = grid->size[k] > longest ? grid->size[k] : longest;
    const int side = BRICK_CELLS * ((longest - 1) / (BRICK_CELLS * BRICKS_ALONG) + 1);
    for (int k = 0; k < 3; k++)
        count[k] = grid->size[k] > side ? (grid->size[k] - 2) / side + 1 : 1;
    return side;
}

/* Neighbours share faces: at most one face per pair of bricks. */
static size_t most_faces(const int size[3])
{
    const size_t x = (size_t)size[0], y = (size_t)size[1], z = (size_t)size[2];
    return (x + 1) * y * z + x * (y + 1) * z + x * y * (z + 1);
}

static void follow_size(Bricks *bricks, const VolumeGrid *grid)
{
    int size[3];
    bricks_of(grid, size);
    if (bricks->map && size[0] == bricks->size[0] && size[1] == bricks->size[1] && size[2] == bricks->size[2])
        return;
    glDeleteTextures(1, &bricks->map);
    glCreateTextures(GL_TEXTURE_3D, 1, &bricks->map);
    glObjectLabel(GL_TEXTURE, bricks->map, -1, "bricks");
    glTextureStorage3D(bricks->map, 1, GL_R32F, size[0], size[1], size[2]);
    glTextureParameteri(bricks->map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(bricks->map, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int k = 0; k < 3; k++)
        bricks->size[k] = size[k];
    if (most_faces(size) <= bricks->capacity)
        return;
    bricks->capacity = most_faces(size);
    glDeleteBuffers(1, &bricks->found);
    glCreateBuffers(1, &bricks->found);
    glObjectLabel(GL_BUFFER, bricks->found, -1, "brick faces");
    glNamedBufferStorage(bricks->found, (GLsizeiptr)(bricks->capacity * sizeof(GLuint)), NULL, 0);
}

/* One invocation per brick: at most BRICKS_ALONG^3. */
static void dispatch(const Bricks *bricks)
{
    glDispatchCompute(((GLuint)(bricks->size[0] * bricks->size[1] * bricks->size[2]) + 63) / 64, 1, 1);
}

/* Without a volume (field summed at the sample), every brick may hold fluid. */
static void fill_map(const Bricks *bricks, const Volume *volume)
{
    static const GLfloat much = 1e30F;
    if (!volume->field) {
        glClearTexImage(bricks->map, 0, GL_RED, GL_FLOAT, &much);
        return;
    }
    glBindImageTexture(GREATEST_IMAGE, bricks->map, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    glUseProgram(bricks->greatest);
    dispatch(bricks);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void bricks_make(Bricks *bricks, const Volume *volume)
{
    static const GLuint none[5] = {0, 1, 0, 0, 0};
    follow_size(bricks, &volume->grid);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    fill_map(bricks, volume);
    glNamedBufferSubData(bricks->commands, 0, sizeof none, none);
    glBindTextureUnit(GREATEST_UNIT, bricks->map);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FACES_STORAGE, bricks->found);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FACES_COMMAND_STORAGE, bricks->commands);
    glUseProgram(bricks->list);
    dispatch(bricks);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void bricks_draw_faces(Bricks *bricks)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FACES_STORAGE, bricks->found);
    glUseProgram(bricks->faces);
    quad_indices_draw_indirect(&bricks->quads, bricks->capacity, bricks->commands, 0);
}
