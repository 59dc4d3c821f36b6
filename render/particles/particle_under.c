#include "render/particles/particle_under.h"

#include <epoxy/gl.h>
#include <math.h>

enum { PART = 4096 }; /* particles per read */

/* The best particles so far. */
typedef struct Found {
    double radius, depth, beside; /* m: ball radius; distance along the ray to the first ball; distance of
                                     the nearest centre from the ray */
    size_t first, near;           /* particle numbers; SIZE_MAX: none */
} Found;

static void look_at(Found *found, const SightRay *ray, const float at[3], size_t number)
{
    double from[3], along = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = (double)at[k] - ray->from[k];
        along += from[k] * ray->along[k];
        square += from[k] * from[k];
    }
    const double beside = sqrt(fmax(square - along * along, 0)), inside = found->radius - beside;
    if (!(along > 0 && beside < 3 * found->radius)) /* also rejects NaN */
        return;
    const double depth = along - sqrt(fmax(inside * (found->radius + beside), 0));
    if (inside >= 0 && depth < found->depth) {
        found->depth = depth;
        found->first = number;
    }
    if (beside < found->beside) {
        found->beside = beside;
        found->near = number;
    }
}

static void read_part(const ParticleAttribute *from, size_t first, size_t count, void *to)
{
    glGetNamedBufferSubData(from->buffer, (GLintptr)(from->offset + first * from->stride),
                            (GLsizeiptr)(count * from->stride), to);
}

/* Returns the particle's number, or SIZE_MAX. */
static size_t number_under(const ParticleBuffers *particles, const SightRay *ray, double radius)
{
    float places[4 * PART];
    Found found = {radius, INFINITY, INFINITY, SIZE_MAX, SIZE_MAX};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (size_t first = 0; first < particles->count; first += PART) {
        const size_t count = particles->count - first < PART ? particles->count - first : PART;
        read_part(&particles->position, first, count, places);
        for (size_t i = 0; i < count; i++)
            look_at(&found, ray, places + 4 * i, first + i);
    }
    return found.first != SIZE_MAX ? found.first : found.near;
}

bool particle_under(const ParticleBuffers *particles, const SightRay *ray, double radius, uint32_t *id)
{
    const size_t best = particles->id.buffer ? number_under(particles, ray, radius) : SIZE_MAX;
    if (best != SIZE_MAX)
        glGetNamedBufferSubData(particles->id.buffer,
                                (GLintptr)(particles->id.offset + best * particles->id.stride), sizeof *id,
                                id);
    return best != SIZE_MAX;
}

bool particle_place_under(const ParticleBuffers *particles, const SightRay *ray, double radius, double at[3])
{
    float place[4];
    const size_t best = number_under(particles, ray, radius);
    if (best == SIZE_MAX)
        return false;
    read_part(&particles->position, best, 1, place);
    for (int k = 0; k < 3; k++)
        at[k] = (double)place[k];
    return true;
}
