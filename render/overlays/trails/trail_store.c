#include "render/overlays/trails/trails_private.h"
#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/trails/trails_bindings.h"
#include "sim/flow/flow.h"
#include "sim/gpu/gl.h"
#include "sim/start/start.h"

#include <epoxy/gl.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int trails_listed_ids(const TrailsDef *def, uint32_t ids[TRAILS_LISTED_MAX])
{
    int count = 0;
    const char *at = def->ids + strspn(def->ids, " ,");
    if (strcmp(def->ids, "all") == 0)
        return 0;
    while (*at) {
        char *end = NULL;
        const unsigned long long id = *at >= '0' && *at <= '9' ? strtoull(at, &end, 10) : ULLONG_MAX;
        if (id > INT64_MAX || count == TRAILS_LISTED_MAX || !strchr(" ,", *end))
            return -1;
        ids[count++] = (uint32_t)id; /* as buffers have them: 32 of 64 bits */
        at = end + strspn(end, " ,");
    }
    return count > 0 ? count : -1;
}

double trails_every(const TrailsDef *def)
{
    enum { USUAL_POINTS = 64 };
    const double least = def->length / (TRAILS_POINTS_MAX - 2);
    return fmax(def->every > 0 ? def->every : def->length / USUAL_POINTS, least);
}

static int trails_points(const TrailsDef *def)
{
    return (int)fmin(ceil(def->length / trails_every(def)), TRAILS_POINTS_MAX - 2) + 2;
}

bool trail_ring_create(TrailRing *ring, double length, double every, int points)
{
    const int capacity = points + 1;
    *ring = (TrailRing){.capacity = capacity, .length = length, .every = every};
    ring->column = calloc((size_t)capacity, sizeof *ring->column);
    return ring->column != NULL;
}

void trail_ring_destroy(TrailRing *ring)
{
    free(ring->column);
    *ring = (TrailRing){0};
}

/* Forgets all columns. */
static void trail_ring_clear(TrailRing *ring)
{
    ring->begin = ring->end;
    ring->gap = 0;
    ring->drops++;
}

TrailColumn *trail_ring_at(const TrailRing *ring, uint64_t number)
{
    return &ring->column[number % (uint64_t)ring->capacity];
}

bool trail_ring_joins(const TrailRing *ring, uint64_t number)
{
    return number > ring->begin && !trail_ring_at(ring, number)->broken;
}

static double newest_column(const TrailRing *ring)
{
    return trail_ring_at(ring, ring->end - 1)->time;
}

/* Almost equal times are of the same state, or of a substitute. */
static void drop_newer(TrailRing *ring, double time)
{
    const uint64_t end = ring->end;
    while (ring->end > ring->begin && newest_column(ring) >= time - 1e-9 * fmax(fabs(time), ring->every))
        ring->end--;
    ring->drops += ring->end < end;
}

static void drop_old(TrailRing *ring)
{
    while (ring->end - ring->begin >= (uint64_t)ring->capacity)
        ring->begin++;
    while (ring->begin + 1 < ring->end &&
           trail_ring_at(ring, ring->begin + 1)->time < ring->now - ring->length)
        ring->begin++;
}

/* The motion during a gap is unknown if the gap is longer than a trail, or suddenly long: a jump in time,
   or a window that stood still. A film that plays fast has such gaps all the time, which are no jumps. */
static bool is_jump(const TrailRing *ring, double gap)
{
    return gap > ring->length || (ring->gap > 0 && gap > 8 * ring->gap && gap > ring->length / 4);
}

void trail_ring_add(TrailRing *ring, double time, Scalar scalar)
{
    const double gap = time - ring->now;
    drop_newer(ring, time);
    const bool first = ring->end == ring->begin, back = gap <= 0;
    const bool broken = first || (!back && is_jump(ring, gap));
    ring->now = time;
    ring->gap = back || first ? 0 : gap;
    ring->head = ring->end;
    *trail_ring_at(ring, ring->head) = (TrailColumn){time, scalar, broken};
    if (broken || time - newest_column(ring) >= 0.999 * ring->every)
        ring->end++;
    drop_old(ring);
}

enum {
    SLOTS_LEAST = 1024,    /* growing slowly at first: a tap that opens would otherwise restart the trails
                              at each picture */
    POINTS_MOST = 8 << 20, /* points of all trails: 160 MB */
    POINT_BYTES = 4 * sizeof(float)
};

static const uint32_t NOBODY = UINT32_MAX; /* one id of 2^32 looks like NOBODY */

bool trail_store_create(TrailStore *store, const Subject *subject, Error *error)
{
    static const char *const claim[] = {"trails/trails_claim.comp", NULL};
    static const char *const take[] = {"trails/trails_take.comp", NULL};
    const WorldDef *world = subject->world;
    const size_t seeds = world->spacing > 0 ? seed_count(world, world->spacing) : 0;
    store->capacity = world->spacing > 0 ? flow_capacity(world, seeds) : 0;
    store->least = store->capacity > seeds || store->capacity == 0 ? SLOTS_LEAST : 1;
    store->claim = program_create("trails claim", claim, NULL, error);
    store->take = store->claim ? program_create("trails take", take, NULL, error) : 0;
    return store->take != 0;
}

static void drop_buffers(TrailStore *store)
{
    glDeleteBuffers(1, &store->places);
    glDeleteBuffers(1, &store->owners);
    glDeleteBuffers(1, &store->seen);
    glDeleteBuffers(1, &store->claims);
    glDeleteBuffers(1, &store->none);
    if (store->taken)
        glDeleteSync(store->taken);
    store->taken = NULL;
    store->mapped_places = NULL;
    store->mapped_owners = NULL;
    store->places = store->owners = store->seen = store->claims = store->none = 0;
    store->slots = 0;
    trail_ring_destroy(&store->ring);
}

void trail_store_destroy(TrailStore *store)
{
    drop_buffers(store);
    glDeleteProgram(store->claim);
    glDeleteProgram(store->take);
    *store = (TrailStore){0};
}

static void clear_trails(unsigned buffer, size_t first, size_t count, uint32_t value)
{
    glClearNamedBufferSubData(buffer, GL_R32UI, (GLintptr)(first * sizeof value),
                              (GLsizeiptr)(count * sizeof value), GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

/* Computes the number of trails and the stride in ids. */
static void count_slots(TrailStore *store, const TrailsDef *def, int points)
{
    const size_t most = (size_t)fmin(TRAILS_MOST, floor(POINTS_MOST / (double)(points + 1)));
    const size_t wanted = (store->capacity + (size_t)def->stride - 1) / (size_t)def->stride;
    store->stride = wanted > most ? (int)((store->capacity + most - 1) / most) : def->stride;
    store->slots = (int)(wanted > most ? most : wanted > store->least ? wanted : store->least);
    if (store->listed_count > 0)
        store->slots = TRAILS_LISTED_MAX; /* room for later additions */
}

/* As work_buffer_remake, mapped for drawing by the CPU. */
static const void *make_mapped(unsigned *buffer, size_t size, const char *label)
{
    const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glDeleteBuffers(1, buffer);
    glCreateBuffers(1, buffer);
    glObjectLabel(GL_BUFFER, *buffer, -1, label);
    glNamedBufferStorage(*buffer, (GLsizeiptr)size, NULL, access);
    return glMapNamedBufferRange(*buffer, 0, (GLsizeiptr)size, access);
}

static void make_points(TrailStore *store, size_t points)
{
    static const char *const labels[] = {"trails' points", "trails' owners"};
    if (gl_renderer_is_software()) {
        store->mapped_places = make_mapped(&store->places, points * POINT_BYTES, labels[0]);
        store->mapped_owners = make_mapped(&store->owners, points * sizeof(uint32_t), labels[1]);
    } else {
        work_buffer_remake(&store->places, points * POINT_BYTES, labels[0]);
        work_buffer_remake(&store->owners, points * sizeof(uint32_t), labels[1]);
    }
}

static bool make_buffers(TrailStore *store)
{
    const size_t slots = (size_t)store->slots, points = slots * (size_t)store->ring.capacity;
    gl_debug_errors(); /* drops earlier errors: the query below is for these buffers */
    make_points(store, points);
    work_buffer_remake(&store->seen, slots * sizeof(uint32_t), "trails seen");
    work_buffer_remake(&store->claims, slots * sizeof(uint32_t), "trails claimed");
    work_buffer_remake(&store->none, 4 * sizeof(uint32_t), "trails without a scalar");
    return gl_errors_take(GL_OUT_OF_MEMORY) == 0;
}

/* True if the ids are unchanged, or if a list follows a list: then each id has a slot. */
static bool list_goes_on(const TrailStore *store, const TrailsDef *def)
{
    uint32_t ids[TRAILS_LISTED_MAX];
    return strcmp(def->ids, store->def.ids) == 0 ||
           (store->listed_count > 0 && trails_listed_ids(def, ids) > 0);
}

static int place_of(const uint32_t ids[], int count, uint32_t id)
{
    int at = 0;
    while (at < count && ids[at] != id)
        at++;
    return at;
}

/* Frees a slot in all columns. */
static void forget_trails(TrailStore *store, int slot)
{
    for (int k = 0; k < store->ring.capacity; k++)
        clear_trails(store->owners, (size_t)k * (size_t)store->slots + (size_t)slot, 1, 0);
    clear_trails(store->seen, (size_t)slot, 1, 0);
    store->listed[slot] = NOBODY;
    store->made++;
}

/* Ids that stay keep slot and past; new ids take freed slots. */
static void follow_list(TrailStore *store, const TrailsDef *def)
{
    uint32_t ids[TRAILS_LISTED_MAX];
    const int count = trails_listed_ids(def, ids);
    for (int slot = 0; slot < store->listed_count; slot++)
        if (store->listed[slot] != NOBODY && place_of(ids, count, store->listed[slot]) == count)
            forget_trails(store, slot);
    for (int i = 0; i < count; i++) {
        if (place_of(store->listed, store->listed_count, ids[i]) < store->listed_count)
            continue;
        const int slot = place_of(store->listed, store->listed_count, NOBODY);
        store->listed[slot] = ids[i];
        store->listed_count += slot == store->listed_count;
    }
}

/* True if the present buffers fit the state and settings; else the trails restart. */
static bool has_free_slot(const TrailStore *store, const TrailsDef *def, size_t count)
{
    const TrailsDef *was = &store->def;
    return store->slots > 0 && count <= store->capacity && def->stride == was->stride &&
           trails_points(def) + 1 == store->ring.capacity && list_goes_on(store, def);
}

static void free_slot(TrailStore *store, const TrailsDef *def, size_t count)
{
    const int points = trails_points(def);
    if (has_free_slot(store, def, count)) {
        follow_list(store, def);
        return;
    }
    drop_buffers(store);
    store->made++;
    store->listed_count = trails_listed_ids(def, store->listed);
    if (store->listed_count < 0)
        return;
    if (count > store->capacity)
        store->capacity = work_capacity(store->capacity, count);
    count_slots(store, def, points);
    if (!trail_ring_create(&store->ring, def->length, trails_every(def), points) || !make_buffers(store))
        drop_buffers(store);
    else {
        static const uint32_t no_number = 0x7fc00000;
        clear_trails(store->seen, 0, (size_t)store->slots, 0);
        clear_trails(store->none, 0, 4, no_number);
    }
}

unsigned trail_store_column(const TrailStore *store, uint64_t number)
{
    return (unsigned)(number % (uint64_t)store->ring.capacity) * (unsigned)store->slots;
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* A new choice of particles starts now; a new box means a new fluid. */
static void follow_choice(TrailStore *store, const TrailsDef *def, const ParticleBuffers *particles)
{
    const TrailsDef *was = &store->def;
    const bool other = !same3(particles->box_size, store->box_size) || particles->spacing != store->spacing;
    if (other || !same3(def->region_min, was->region_min) || !same3(def->region_max, was->region_max) ||
        !same3(def->plane_point, was->plane_point) || !same3(def->plane_normal, was->plane_normal))
        clear_trails(store->seen, 0, (size_t)store->slots, 0);
    if (other)
        trail_ring_clear(&store->ring);
    memcpy(store->box_size, particles->box_size, sizeof store->box_size);
    store->spacing = particles->spacing;
    store->ring.length = def->length;
    store->ring.every = trails_every(def);
    store->def = *def;
}

/* After a step back, restores the choice of that time: later plane crossings have not happened yet. */
static void go_back_to(const TrailStore *store)
{
    const TrailRing *ring = &store->ring;
    const GLsizeiptr bytes = (GLsizeiptr)((size_t)store->slots * sizeof(uint32_t));
    if (ring->head == ring->begin)
        clear_trails(store->seen, 0, (size_t)store->slots, 0);
    else
        glCopyNamedBufferSubData(store->owners, store->seen,
                                 (GLintptr)(sizeof(uint32_t) * trail_store_column(store, ring->head - 1)), 0,
                                 bytes);
}

static void bind_ids(const TrailStore *store, GLuint program, const ParticleBuffers *particles)
{
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, TRAIL_IDS_STORAGE, particles->id.buffer,
                      (GLintptr)particles->id.offset, (GLsizeiptr)(particles->count * particles->id.stride));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TRAIL_CLAIMS_STORAGE, store->claims);
    glProgramUniform1ui(program, TRAIL_COUNT_AT, (GLuint)particles->count);
    glProgramUniform1ui(program, TRAIL_ID_STRIDE_AT, (GLuint)(particles->id.stride / 4));
    glProgramUniform1ui(program, TRAIL_EVERY_AT, (GLuint)store->stride);
    glProgramUniform1ui(program, TRAIL_SLOTS_AT, (GLuint)store->slots);
    glProgramUniform1ui(program, TRAIL_LISTED_AT, (GLuint)store->listed_count);
    glProgramUniform1uiv(program, TRAIL_LIST_AT, TRAIL_LISTED_IDS, store->listed);
}

void trail_store_bind(const TrailStore *store)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TRAIL_PLACES_STORAGE, store->places);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TRAIL_OWNERS_STORAGE, store->owners);
}

/* Ids may grow without limit where particles come and go, and the store outlives the first scene. */
static bool claim(const TrailStore *store, const ParticleBuffers *particles)
{
    if (store->listed_count > 0)
        return false;
    clear_trails(store->claims, 0, (size_t)store->slots, UINT32_MAX);
    glUseProgram(store->claim);
    bind_ids(store, store->claim, particles);
    work_run(particles->count);
    return true;
}

static void set_fence(TrailStore *store)
{
    if (store->taken)
        glDeleteSync(store->taken);
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    store->taken = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void trail_store_wait(TrailStore *store)
{
    if (!store->taken)
        set_fence(store);
    while (glClientWaitSync(store->taken, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000) == GL_TIMEOUT_EXPIRED)
        ;
    glDeleteSync(store->taken);
    store->taken = NULL;
}

static void set3(GLuint program, GLint location, const double v[3])
{
    glProgramUniform3f(program, location, (GLfloat)v[0], (GLfloat)v[1], (GLfloat)v[2]);
}

static void set_choice(const TrailStore *store, GLuint program)
{
    const TrailsDef *def = &store->def;
    const double *normal = def->plane_normal, *point = def->plane_point;
    set3(program, TRAIL_LEAST_AT, def->region_min);
    set3(program, TRAIL_GREATEST_AT, def->region_max);
    glProgramUniform4f(program, TRAIL_PLANE_AT, (GLfloat)normal[0], (GLfloat)normal[1], (GLfloat)normal[2],
                       (GLfloat)(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2]));
}

static void run_take(const TrailStore *store, const ParticleBuffers *particles, Scalar scalar, bool claimed)
{
    const TrailRing *ring = &store->ring;
    const bool joins = trail_ring_joins(ring, ring->head);
    glUseProgram(store->take);
    particle_bind(store->take, particles, scalar);
    const unsigned shown = particle_bind_one(SHOWN_STORAGE, particle_color_attribute(particles, scalar),
                                             particles->count, store->none);
    bind_ids(store, store->take, particles);
    trail_store_bind(store);
    set_choice(store, store->take);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TRAIL_SEEN_STORAGE, store->seen);
    glUniform1ui(TRAIL_COLUMN_AT, trail_store_column(store, ring->head));
    glUniform1ui(TRAIL_BEFORE_AT, joins ? trail_store_column(store, ring->head - 1) : TRAIL_NO_COLUMN);
    glUniform1ui(TRAIL_CLAIMS_AT, claimed);
    glUniform1ui(SHOWN_STRIDE_AT, shown);
    glUniform1ui(SHOWN_IS_FLUID_AT, scalar == SCALAR_FLUID && shown > 0);
    work_run(particles->count);
}

void trail_store_add_state(TrailStore *store, const ParticleBuffers *particles, const ViewDef *def)
{
    const TrailsDef *own = trails_def(def);
    const bool has = particle_color_attribute(particles, view_color_by(def))->buffer;
    const Scalar scalar = has ? view_color_by(def) : SCALAR_COUNT; /* a scalar that no view shows */
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    free_slot(store, own, particles->count);
    if (store->slots == 0 || (particles->count > 0 && !particles->id.buffer))
        return;
    follow_choice(store, own, particles);
    const bool back = store->ring.end > store->ring.begin && particles->time < store->ring.now;
    trail_ring_add(&store->ring, particles->time, scalar);
    if (back)
        go_back_to(store);
    clear_trails(store->owners, trail_store_column(store, store->ring.head), (size_t)store->slots, 0);
    if (particles->count > 0)
        run_take(store, particles, view_color_by(def), claim(store, particles));
    if (store->mapped_places)
        set_fence(store);
}
