/* Making and freeing the backend's state, and the backend. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/watch_block.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void compute_destroy(void *state)
{
    Compute *c = state;
    const GLuint buffers[] = {
        c->cell,      c->rank,         c->order,        c->start,          c->totals[0],     c->totals[1],
        c->totals[2], c->pressure,     c->acceleration, c->constant_block, c->step,          c->terms,
        c->of_method, c->drag,         c->scratch,      c->near,           c->forces.buffer, c->forces.marked,
        c->solve,     c->coarse_cells, c->coarse_nodes, c->parts};
    compute_particles_destroy(&c->now);
    compute_particles_destroy(&c->spare);
    compute_particles_destroy(&c->marked);
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
    glDeleteBuffers(COMPUTE_BUFFERS, c->of_shaders);
    glDeleteBuffers(COMPUTE_SHOWN, c->shown);
    glDeleteBuffers(COMPUTE_LISTS, c->lists);
    mailbox_destroy(&c->watch);
    mailbox_destroy(&c->gauge);
    mailbox_destroy(&c->energy);
    mailbox_destroy(&c->solves.found);
    for (int k = 0; k < 2; k++)
        mailbox_destroy(&c->forces.sums[k]);
    compute_boundary_destroy(c);
    compute_meshes_destroy(c);
    compute_flow_destroy(c);
    for (int p = 0; p < COMPUTE_PASS_COUNT; p++)
        glDeleteProgram(c->program[p]);
    free(c);
}

static bool buffers_create(Compute *c, Error *error)
{
    const size_t n = c->capacity, places = c->fold.count;
    if (!compute_particles_create(c, &c->now, error) || !compute_particles_create(c, &c->spare, error))
        return false;
    c->cell = compute_buffer(c, "particle cells", 4 * n);
    c->rank = compute_buffer(c, "particle ranks", 4 * n);
    c->order = compute_buffer(c, "particle order", 4 * (n + 1));
    c->start = compute_buffer(c, "cell starts", 4 * (places + 1));
    c->pressure = compute_buffer(c, "particle pressures", 8 * n);
    c->near = compute_buffer(c, "particle positions and pressure terms", 16 * n);
    c->acceleration = compute_buffer(c, "particle accelerations", 16 * n);
    size_t level = (n > places ? n : places) + COMPUTE_LAYER; /* longest scanned array:
                                                                 sim/gpu/compute/flow.c */
    for (int k = 0; k < COMPUTE_SCAN_LEVELS; k++) {
        level = (level + COMPUTE_SCAN_BLOCK - 1) / COMPUTE_SCAN_BLOCK;
        c->totals[k] = compute_buffer(c, "scan totals", 4 * level);
    }
    const bool flows = compute_flow_create(c);
    const bool bounded = compute_boundary_create(c);
    if (!compute_meshes_create(c, error))
        return false;
    return (flows && bounded && !c->full && compute_iterate_fit(c) &&
            mailbox_create(&c->watch, "watch", sizeof(WatchBlock))) ||
           compute_no_memory(c, error);
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

static CellFold fold_of(const Constants *s, size_t capacity)
{
    return cell_fold(s, capacity + s->boundary.count);
}

/* Size of the largest array: a vec4 per particle, or columns of the method; starts of cells. */
static size_t most_bytes(const Constants *s, size_t capacity)
{
    size_t particle =
        larger(16, 4 * larger((size_t)compute_own_of(s).count, (size_t)compute_scratch_of(s).total));
    for (int k = 0; k < COMPUTE_BUFFERS; k++) {
        const ShaderBuffer *own = compute_buffer_at(s, k);
        particle = larger(particle, own && own->needed(s) ? own->size : 0);
    }
    const size_t particles = particle * capacity, places = 4 * (fold_of(s, capacity).count + 2);
    return larger(larger(particles, 16 * s->boundary.count), places);
}

/* Solids use bindings 12 to 15, a method's columns 8 to 10, beside the bindings of the largest pass. */
static bool supported(const Constants *s, size_t capacity, Error *error)
{
    const bool solids = s->solid_count > 0;
    const int columns = (compute_own_of(s).count > 0) + (compute_scratch_of(s).total > 0);
    const int plain = columns > 0 ? 11 : 8;
    const GlLimits have = gl_limits();
    const GlNeeds needs = {.who = solids ? "backend compute with solids" : "backend compute",
                           .instead = "use backend cpu",
                           .least = {.compute_blocks = (solids ? 12 : 8) + columns,
                                     .bindings = solids ? 16 : plain,
                                     .block_bytes = (int64_t)most_bytes(s, capacity)}};
    return gl_limits_allow(&have, &needs, error);
}

static void *compute_create(const Constants *constants, const WorldDef *def, const InitialState *initial,
                            size_t capacity, Error *error)
{
    (void)def;
    if (epoxy_gl_version() < 45) {
        error_set(error, "backend compute needs OpenGL 4.5, and there is %d.%d", epoxy_gl_version() / 10,
                  epoxy_gl_version() % 10);
        return NULL;
    }
    if (!supported(constants, capacity, error))
        return NULL;
    Compute *c = calloc(1, sizeof *c);
    if (!c) {
        error_set(error, "no memory");
        return NULL;
    }
    c->constants = constants;
    c->count = initial->count;
    c->capacity = capacity;
    c->fold = fold_of(constants, capacity);
    c->own = compute_own_of(constants);
    if (!buffers_create(c, error) ||
        !((compute_term_buffers(c) && compute_scratch_fit(c)) || compute_no_memory(c, error))) {
        compute_destroy(c);
        return NULL;
    }
    compute_constants(c);
    compute_lists_create(c); /* last: steps can run without lists */
    if (c->full) {
        compute_no_memory(c, error);
        compute_destroy(c);
        return NULL;
    }
    if (!compute_programs_create(c, error) ||
        !(compute_set_particles(c, initial) || error_set(error, "no memory for %zu particles", c->count))) {
        compute_destroy(c);
        return NULL;
    }
    return c;
}

static bool compute_adapt(void *state, Error *error)
{
    Compute *c = state;
    char defines[COMPUTE_DEFINES_MAX];
    if (!supported(c->constants, c->capacity, error))
        return false;
    if (!compute_own_fit(c))
        return error_set(error, "the GPU has no memory for another term; use a larger spacing");
    compute_all_defines(c, defines);
    if (!compute_term_buffers(c) || !compute_scratch_fit(c) || !compute_iterate_fit(c))
        return error_set(error, "the GPU has no memory for another term; use a larger spacing");
    if (strcmp(defines, c->defines) != 0 && !compute_programs_create(c, error))
        return false;
    compute_constants(c);
    return true;
}

static bool compute_reload(void *state, Error *error)
{
    return compute_programs_create(state, error);
}

static bool has_shader(const Pass *pass)
{
    char path[64];
    snprintf(path, sizeof path, "sim/%s.comp", pass->shader ? pass->shader : "");
    return shader_source_has(path);
}

/* Rejects a method with a pass without a shader, and a scene that names a term with such a pass. */
static bool compute_can(const WorldDef *def, Error *error)
{
    const Method *method = method_find(def->method);
    const Term *of;
    const Pass *pass;
    for (int k = 0; (pass = compute_pass_at(method, k, &of)); k++) {
        if (!(k < COMPUTE_FORCES - COMPUTE_METHOD && (of || has_shader(pass))))
            return error_set(error, "backend compute has no method %s; use backend cpu", def->method);
        if (of && of->named(def) && !has_shader(pass))
            return error_set(error, "backend compute has no %s; use backend cpu", of->words);
    }
    return true;
}

const Backend backend_compute = {
    .name = "compute",
    .gpu = true,
    .help = "compute shaders on the GPU (OpenGL 4.5)",
    .can = compute_can,
    .create = compute_create,
    .destroy = compute_destroy,
    .adapt = compute_adapt,
    .vary = compute_vary,
    .reload = compute_reload,
    .pose = compute_pose,
    .drift = compute_drift,
    .grid = compute_grid,
    .run = compute_pass,
    .iterate = compute_iterate,
    .guess = compute_guess,
    .kick = compute_kick,
    .touch = compute_touch,
    .guide = compute_guide,
    .emit = compute_emit,
    .drain = compute_drain,
    .watch = compute_watch,
    .mark = compute_mark,
    .back = compute_back,
    .share = compute_share,
    .sums = compute_sums,
    .read = compute_read,
    .enable_forces = compute_enable_forces,
    .forces_send = compute_forces_send,
    .forces_take = compute_forces_take,
    .finish = compute_finish,
    .gauge = compute_gauge,
    .gauged = compute_gauged,
    .energy = compute_energy,
    .energy_ahead = compute_energy_ahead,
    .save = compute_save,
    .copies = &compute_copies,
    .load = compute_load,
    .info = compute_info,
};
