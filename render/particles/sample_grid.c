#include "render/particles/particles.h"

#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

/* Centres as many places as fit along `size` m. */
static void fit(SampleGrid *grid, int axis, double size, const double way[3])
{
    grid->count[axis] = (int)fmax(floor(size / grid->cell + 1e-6), 1);
    const double begin = (size - grid->cell * (grid->count[axis] - 1)) / 2;
    for (int k = 0; k < 3; k++) {
        grid->step[axis][k] = grid->cell * way[k];
        grid->first[k] += begin * way[k];
    }
}

static void fit_box(SampleGrid *grid, const double box[3])
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    grid->first[0] = -box[0] / 2;
    grid->first[2] = -box[2] / 2;
    for (int k = 0; k < 3; k++)
        fit(grid, k, box[k], axes[k]);
}

static void fit_plane(SampleGrid *grid, const Plane *plane)
{
    grid->count[2] = 1;
    memcpy(grid->first, plane->corner, sizeof grid->first);
    fit(grid, 0, plane->size[0], plane->along);
    fit(grid, 1, plane->size[1], plane->up);
}

void sample_grid_make(SampleGrid *grid, const double box_size[3], const Plane *plane, double cell,
                      double most)
{
    const double *sides = plane ? plane->size : box_size;
    const int dimensions = plane ? 2 : 3;
    double places = 1;
    for (int k = 0; k < dimensions; k++)
        places *= fmax(sides[k] / cell, 1);
    *grid = (SampleGrid){.cell = cell, .coarser = places > most};
    if (grid->coarser)
        grid->cell *= pow(places / most, 1.0 / dimensions) * 1.1;
    if (plane)
        fit_plane(grid, plane);
    else
        fit_box(grid, box_size);
}

size_t sample_grid_places(const SampleGrid *grid)
{
    return (size_t)grid->count[0] * (size_t)grid->count[1] * (size_t)grid->count[2];
}

static void set3(GLuint program, GLint location, const double v[3])
{
    glProgramUniform3f(program, location, (GLfloat)v[0], (GLfloat)v[1], (GLfloat)v[2]);
}

void sample_grid_set(const SampleGrid *grid, unsigned program)
{
    set3(program, SAMPLE_GRID_FIRST_AT, grid->first);
    set3(program, SAMPLE_GRID_ALONG_AT, grid->step[0]);
    set3(program, SAMPLE_GRID_UP_AT, grid->step[1]);
    set3(program, SAMPLE_GRID_DEEP_AT, grid->step[2]);
    glProgramUniform3ui(program, SAMPLE_GRID_SIDES_AT, (GLuint)grid->count[0], (GLuint)grid->count[1],
                        (GLuint)grid->count[2]);
}

void vectors_bind(unsigned program, const ParticleBuffers *particles, Vector vector, Scalar shown,
                  unsigned no_scalar)
{
    const size_t count = particles->count;
    particle_bind(program, particles, shown);
    glProgramUniform1ui(program, VECTOR_STRIDE_AT,
                        particle_bind_one(VECTORS_STORAGE, &particles->vector[vector], count, 0));
    glProgramUniform1ui(
        program, SHOWN_STRIDE_AT,
        particle_bind_one(SHOWN_STORAGE, particle_color_attribute(particles, shown), count, no_scalar));
    glProgramUniform1ui(program, SHOWN_IS_FLUID_AT, shown == SCALAR_FLUID);
}

void mean_set(unsigned program, double support_radius, int dimensions)
{
    const double norm = plane_kernels[plane_kernel_named("wendland_c2")].norm[dimensions - 2];
    glProgramUniform1f(program, MEAN_SUPPORT_AT, (GLfloat)support_radius);
    glProgramUniform1f(program, MEAN_PEAK_AT, (GLfloat)(norm / pow(support_radius, dimensions)));
}
