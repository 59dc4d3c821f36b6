#include "app/output/step_buffers.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

void step_buffers_destroy(StepBuffers *buffers)
{
    if (buffers->upload) {
        derived_destroy(&buffers->derived);
        upload_destroy(buffers->upload);
    }
    *buffers = (StepBuffers){0};
}

/* Births come from the file, so need no ids. */
unsigned step_attributes(Scalar scalar)
{
    const ParticleWants wants = {.scalars = SCALAR_BIT(scalar)};
    return (int)scalar < SCALAR_STATE_COUNT ? PARTICLE_SCALAR(scalar)
                                            : wants_attributes(&wants) & ~PARTICLE_ID;
}

static void free_arrays(ParticleArrays *arrays)
{
    free(arrays->position);
    free(arrays->velocity);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        free(arrays->scalar[s]);
}

/* `attributes`: PARTICLE_*. */
static bool make_arrays(ParticleArrays *arrays, unsigned attributes, size_t count)
{
    const bool moves = attributes & PARTICLE_VELOCITY;
    arrays->position = calloc(count + 1, sizeof(float[4]));
    arrays->velocity = moves ? calloc(count + 1, sizeof(float[4])) : NULL;
    bool made = arrays->position && (arrays->velocity || !moves);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (attributes & PARTICLE_SCALAR(s))
            made = (arrays->scalar[s] = calloc(count + 1, sizeof(float))) && made;
    return made;
}

static ParticleBuffers state_of(const SnapshotScene *scene, const SnapshotStep *step)
{
    ParticleBuffers state = {.count = step->count,
                             .spacing = scene->spacing,
                             .support_radius = scene->support_radius,
                             .box = step->box,
                             .time = step->time};
    snapshot_floating(step, state.floating);
    memcpy(state.box_size, scene->box_size, sizeof state.box_size);
    return state;
}

/* Makes buffers for at least `count` particles, with a margin, as counts in a series may grow. `attributes`:
   PARTICLE_*. */
static bool follow_count(StepBuffers *buffers, size_t count, unsigned attributes, Error *error)
{
    if (buffers->upload && count <= buffers->capacity)
        return true;
    upload_destroy(buffers->upload);
    buffers->capacity = count + count / 2 + 1;
    buffers->upload = upload_create(buffers->capacity, attributes, error);
    return buffers->upload != NULL;
}

static bool derive(Derived *derived, const ParticleWants *wants, const SnapshotScene *scene, Scalar scalar,
                   ParticleBuffers *buffers, Error *error)
{
    DerivedSpace space = {.flat = scene->dimensions == 2};
    memcpy(space.periodic, scene->periodic, sizeof space.periodic);
    if (!derived_follow(derived, wants, error))
        return false;
    derived_fill(derived, wants, &space, buffers);
    return buffers->count == 0 || buffers->scalar[scalar].buffer ||
           error_set(error, "the GPU has no memory for %s",
                     derived->lacks ? derived->lacks : scalar_name(scalar));
}

bool step_buffers_make(StepBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                       SnapshotVolume volume, Scalar scalar, ParticleBuffers *out, Error *error)
{
    const ParticleWants wants = {.scalars = SCALAR_BIT(scalar)};
    const ParticleBuffers state = state_of(scene, step);
    const unsigned attributes = step_attributes(scalar);
    ParticleArrays arrays = {0};
    bool made =
        make_arrays(&arrays, attributes, step->count) || error_set(error, "out of memory for the particles");
    if (made)
        snapshot_arrays(scene, step, volume, &arrays);
    made = made && follow_count(buffers, step->count, attributes, error) &&
           upload_arrays(buffers->upload, &arrays, &state, error) && upload_take(buffers->upload, out) &&
           derive(&buffers->derived, &wants, scene, scalar, out, error);
    free_arrays(&arrays);
    return made;
}

static void read_scalar(const ParticleAttribute *from, size_t count, float *values)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * sizeof *values),
                            values);
}

bool step_buffers_scalar(StepBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                         Scalar scalar, float *values, Error *error)
{
    ParticleArrays arrays = {0};
    ParticleBuffers made;
    if ((int)scalar < SCALAR_STATE_COUNT) {
        arrays.scalar[scalar] = values;
        snapshot_arrays(scene, step, SNAPSHOT_VOLUME, &arrays);
        return true;
    }
    if (!step_buffers_make(buffers, scene, step, SNAPSHOT_VOLUME, scalar, &made, error))
        return false;
    read_scalar(&made.scalar[scalar], step->count, values);
    return true;
}
