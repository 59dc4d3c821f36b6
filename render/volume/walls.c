#include "render/volume/walls.h"

#include "render/frame/frame.h"
#include "render/particles/work.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

enum { GROUP = 64 };

/* A side of an axis. */
typedef struct Wall {
    int axis, inwards, cells;
    double place; /* cells from the volume's corner */
} Wall;

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
static void add_images(const Wall *wall, const Volume *volume)
{
    const int *size = volume->grid.size, axis = wall->axis;
    const int first = wall->inwards > 0 ? (int)ceil(wall->place - 0.5) : (int)floor(wall->place - 0.5);
    const size_t all =
        (size_t)size[0] * (size_t)size[1] * (size_t)size[2] / (size_t)size[axis] * (size_t)wall->cells;
    glUniform1i(WALL_AXIS_AT, axis);
    glUniform1f(WALL_PLACE_AT, (GLfloat)wall->place);
    glUniform3i(WALL_CELLS_AT, first, wall->cells, wall->inwards);
    work_dispatch((all + GROUP - 1) / GROUP);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

static void mirror(const Volume *volume, unsigned texture, int axis, double low, double high)
{
    const VolumeGrid *grid = &volume->grid;
    const double between = ceil((high - low) / grid->cell), reach = ceil(volume->support / grid->cell);
    const int cells = (int)fmin(between, reach);
    glBindImageTexture(FIELD_IMAGE, texture, 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32F);
    add_images(&(Wall){axis, 1, cells, (low - grid->corner[axis]) / grid->cell}, volume);
    add_images(&(Wall){axis, -1, cells, (high - grid->corner[axis]) / grid->cell}, volume);
}

void volume_walls_mirror(const VolumeWalls *walls, const ParticleBuffers *particles, const bool periodic[3],
                         Volume *volume)
{
    const bool flat = frame_slab(particles) > 0;
    if (!volume->field)
        return;
    glUseProgram(walls->program);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    for (int axis = 0; axis < 3; axis++) {
        const double size = particles->box_size[axis], low = axis == 1 ? 0 : -size / 2;
        volume->walled[axis] = !periodic[axis] && !(flat && axis == 2);
        if (!volume->walled[axis])
            continue;
        mirror(volume, volume->field, axis, low, low + size);
        if (volume->scalar)
            mirror(volume, volume->scalar, axis, low, low + size);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}
