/* Passes, buffers and scratch columns for shaders: of the method, then of the shared terms. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/solve_block.h"
#include "shaders/sim/watch_block.h"
#include "sim/gpu/gl_context.h"
#include "sim/gpu/program.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const Pass *compute_pass_at(const Method *method, int k, const Term **of)
{
    *of = NULL;
    for (const Pass *const *pass = method->passes; *pass; pass++)
        if (k-- == 0)
            return *pass;
    for (const Term *const *term = shared_terms; *term; term++)
        for (const Pass *const *pass = (*term)->passes; *pass; pass++)
            if (k-- == 0) {
                *of = *term;
                return *pass;
            }
    return NULL;
}

static bool compute_pass_needed(const Constants *s, int k)
{
    const Term *of;
    const Pass *pass = compute_pass_at(s->method, k, &of);
    return pass && (!of || of->needed(s)) && (!pass->needed || pass->needed(s));
}

ComputePass compute_method_pass(const Compute *c, const Pass *pass)
{
    const Term *of;
    int k = 0;
    while (compute_pass_at(c->constants->method, k, &of) != pass)
        k++;
    return (ComputePass)(COMPUTE_METHOD + k);
}

/* Entry k of a list that ends with a NULL block; NULL if there is none. */
static const ShaderBuffer *buffer_in(const ShaderBuffer *list, int k)
{
    for (; list && list->block; list++)
        if (k-- == 0)
            return list;
    return NULL;
}

static const Term *term_at(int k)
{
    const Term *const *term = shared_terms;
    while (*term && k-- > 0)
        term++;
    return *term;
}

const ShaderBuffer *compute_buffer_at(const Constants *s, int k)
{
    const Term *term = k < METHOD_BUFFERS_MAX ? NULL : term_at(k - METHOD_BUFFERS_MAX);
    return k < METHOD_BUFFERS_MAX ? buffer_in(s->method->buffers, k) : term ? term->buffer : NULL;
}

static bool in_scratch(const Constants *s, const ColumnDef *column)
{
    return column->flags & COLUMN_SHADERS && !(column->flags & (COLUMN_SAVED | COLUMN_SORTED)) &&
           (!column->needed || column->needed(s));
}

static void scratch_add(const Constants *s, const ColumnDef *columns, const Term *of, ComputeScratch *scratch)
{
    for (; columns && columns->name; columns++)
        if (in_scratch(s, columns)) {
            scratch->of[scratch->count] = of;
            scratch->row[scratch->count++] = columns;
            scratch->total += columns->components;
        }
}

ComputeScratch compute_scratch_of(const Constants *s)
{
    ComputeScratch scratch = {0};
    scratch_add(s, s->method->columns, NULL, &scratch);
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->needed(s))
            scratch_add(s, (*term)->columns, *term, &scratch);
    return scratch;
}

/* Stages of a step. */

void compute_bind(const unsigned *buffers, int count)
{
    for (int k = 0; k < count; k++)
        if (buffers[k])
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)k, buffers[k]);
}

void compute_dispatch(size_t groups)
{
    const size_t rows = (groups + COMPUTE_ALONG - 1) / COMPUTE_ALONG;
    glDispatchCompute((GLuint)(rows > 1 ? COMPUTE_ALONG : groups), (GLuint)rows, 1);
}

void compute_run(const Compute *compute, ComputePass pass, size_t count)
{
    enum { FIRST = CONSTANT_BLOCK }; /* first of five consecutive blocks */
    const GLuint blocks[] = {[CONSTANT_BLOCK - FIRST] = compute->constant_block,
                             [STEP_BLOCK - FIRST] = compute->step,
                             [TERM_BLOCK - FIRST] = compute->terms,
                             [WATCH_BLOCK - FIRST] = compute->watch.buffer,
                             [METHOD_BLOCK - FIRST] = compute->of_method};
    glBindBuffersBase(GL_UNIFORM_BUFFER, FIRST, sizeof blocks / sizeof *blocks, blocks);
    glUseProgram(compute->program[pass]);
    if (compute->decided && pass >= COMPUTE_METHOD) {
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, compute->solve.buffer);
        glDispatchComputeIndirect(offsetof(SolveBlock, groups_along));
    } else
        compute_dispatch((count + COMPUTE_GROUP - 1) / COMPUTE_GROUP);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT);
}

static void compute_drift(void *state, const BoxStep *step)
{
    Compute *c = state;
    compute_set_drift(c, step);
    if (step->solids)
        compute_boundary_move(c, step->solids);
    compute_sweep(c, COMPUTE_DRIFT, c->count);
}

void compute_pass(void *state, const Pass *pass, const PassInput *input)
{
    Compute *c = state;
    const ComputePass at = compute_method_pass(c, pass);
    compute_boundary_grid(c); /* a drift may have moved the solids */
    if (c->takes_dt[at])
        glProgramUniform1f(c->program[at], PASS_DT_AT, input->dt);
    if ((pass->stage == STAGE_FORCE || pass->stage == STAGE_INTEGRATE) && input->apparent)
        compute_set_force(c, input);
    if (pass->mirrors && c->constants->solid_count > 0)
        compute_boundary_fill(c);
    compute_sweep(c, at, c->count);
    if (pass->felt)
        compute_feel_solids(c, pass, input->dt);
}

static void compute_kick(void *state, const float gravity[3], float dt)
{
    Compute *c = state;
    compute_set_kick(c, gravity, dt);
    compute_sweep(c, COMPUTE_KICK, c->count);
    compute_watch_note(c, dt);
    c->felt.seconds += (double)dt;
}

static void compute_touch(void *state, const FingerStep *finger)
{
    const Compute *c = state;
    const GLuint program = c->program[COMPUTE_TOUCH];
    const float *at = finger->at, *v = finger->velocity;
    glProgramUniform4f(program, FINGER_AT, at[0], at[1], at[2], finger->inverse_radius2);
    glProgramUniform4f(program, FINGER_VELOCITY_AT, v[0], v[1], v[2], finger->grip);
    glProgramUniform1f(program, FINGER_KICK_AT, finger->kick);
    compute_sweep(c, COMPUTE_TOUCH, c->count);
}

static const char *const pass_names[] = {
#define X(NAME, name) name,
    COMPUTE_PASSES(X)
#undef X
};

bool compute_no_memory(const Compute *c, Error *error)
{
    return error_set(error, "the GPU has no memory for %zu particles and %zu cells; use a larger spacing",
                     c->count, c->fold.count);
}

static void compute_destroy(void *state)
{
    Compute *c = state;
    const GLuint buffers[] = {c->cell,      c->rank,      c->order,       c->start,        c->totals[0],
                              c->totals[1], c->totals[2], c->pressure,    c->acceleration, c->constant_block,
                              c->step,      c->terms,     c->of_method,   c->drag,         c->scratch,
                              c->lists,     c->near,      c->felt.buffer, c->felt.marked};
    compute_particles_destroy(&c->now);
    compute_particles_destroy(&c->spare);
    compute_particles_destroy(&c->marked);
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
    glDeleteBuffers(COMPUTE_BUFFERS, c->of_shaders);
    glDeleteBuffers(COMPUTE_SHOWN, c->shown);
    mailbox_destroy(&c->watch);
    mailbox_destroy(&c->gauge);
    mailbox_destroy(&c->energy);
    mailbox_destroy(&c->solve);
    mailbox_destroy(&c->parts);
    compute_boundary_destroy(c);
    compute_meshes_destroy(c);
    compute_flow_destroy(c);
    for (int p = 0; p < COMPUTE_PASS_COUNT; p++)
        glDeleteProgram(c->program[p]);
    free(c);
}

unsigned compute_buffer(Compute *c, const char *label, size_t bytes)
{
    GLuint name;
    const size_t size = bytes > 0 ? bytes : 16;
    glCreateBuffers(1, &name);
    glObjectLabel(GL_BUFFER, name, -1, label);
    gl_debug_asks_for_memory(true);
    glNamedBufferStorage(name, (GLsizeiptr)size, NULL, GL_DYNAMIC_STORAGE_BIT);
    const bool none = gl_errors_take(GL_OUT_OF_MEMORY) > 0;
    gl_debug_asks_for_memory(false);
    c->full |= none;
    if (none) { /* a name without storage would be taken for a buffer */
        glDeleteBuffers(1, &name);
        return 0;
    }
    glClearNamedBufferData(name, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    c->bytes += size;
    return name;
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
    compute_flow_create(c);
    const bool bounded = compute_boundary_create(c);
    if (!compute_meshes_create(c, error))
        return false;
    return (bounded && !c->full && compute_iterate_fit(c) &&
            mailbox_create(&c->watch, "watch", sizeof(WatchBlock))) ||
           compute_no_memory(c, error);
}

typedef struct Source {
    const char *label;
    char path[64], defines[COMPUTE_DEFINES_MAX];
} Source;

/* Index of the pass among the method's passes, then the terms' passes, for the shader of `pass`. */
static int of_method(ComputePass pass)
{
    return (int)pass - (pass < COMPUTE_FELT ? COMPUTE_METHOD : COMPUTE_FELT);
}

static Source source_of(const Compute *c, ComputePass pass, const char *defines)
{
    const Term *of;
    Source source = {.label = pass < COMPUTE_METHOD
                                  ? pass_names[pass]
                                  : compute_pass_at(c->constants->method, of_method(pass), &of)->shader};
    snprintf(source.path, sizeof source.path, "sim/%s.comp", source.label);
    snprintf(source.defines, sizeof source.defines, "%s", defines);
    if (compute_feels(pass))
        compute_felt_defines(c, pass, source.defines);
    return source;
}

unsigned compute_program(const Compute *c, ComputePass pass, const char *defines, Error *error)
{
    const Source source = source_of(c, pass, defines);
    return program_create(source.label, (const char *const[]){source.path, NULL}, source.defines, error);
}

static bool finished(const Compute *c, ComputePass pass, unsigned program, const char *defines, Error *error)
{
    const Source source = source_of(c, pass, defines);
    return program_finish(program, source.label, (const char *const[]){source.path, NULL}, source.defines,
                          error);
}

static unsigned begun(const Compute *c, ComputePass pass, const char *defines, Error *error)
{
    const Source source = source_of(c, pass, defines);
    return program_begin(source.label, (const char *const[]){source.path, NULL}, source.defines, error);
}

/* True if the pass needs a program: the scene's terms need the pass, or the pass was requested. */
static bool pass_wanted(const Compute *c, ComputePass pass)
{
    const Term *of;
    if (pass >= COMPUTE_METHOD && !compute_pass_needed(c->constants, of_method(pass)))
        return false;
    if (pass >= COMPUTE_FELT)
        return c->felt.to && c->constants->solid_count > 0 &&
               compute_pass_at(c->constants->method, of_method(pass), &of)->felt;
    if (pass >= COMPUTE_METHOD)
        return true;
    if (pass == COMPUTE_OWN_MOVE || pass == COMPUTE_OWN_GATHER)
        return c->own.count > 0;
    return pass == COMPUTE_GAUGE || pass == COMPUTE_ENERGY ? c->program[pass] != 0
                                                           : compute_pass_named(c->constants, pass);
}

static void all_defines(const Compute *c, char out[COMPUTE_DEFINES_MAX])
{
    compute_defines(c->constants, out);
    compute_own_defines(c, out);
    compute_list_defines(c, out);
}

bool compute_programs(Compute *c, bool (*which)(ComputePass pass), Error *error)
{
    char defines[COMPUTE_DEFINES_MAX];
    unsigned program[COMPUTE_PASS_COUNT] = {0};
    bool ok = true;
    all_defines(c, defines);
    for (int p = 0; ok && p < COMPUTE_PASS_COUNT; p++)
        if (which((ComputePass)p) && pass_wanted(c, (ComputePass)p))
            ok = (program[p] = begun(c, (ComputePass)p, defines, error)) != 0;
    for (int p = 0; ok && p < COMPUTE_PASS_COUNT; p++)
        ok = !program[p] || finished(c, (ComputePass)p, program[p], defines, error);
    for (int p = 0; p < COMPUTE_PASS_COUNT; p++)
        if (ok && which((ComputePass)p)) {
            glDeleteProgram(c->program[p]);
            c->program[p] = program[p];
            compute_find_buffers(c, (ComputePass)p);
        } else
            glDeleteProgram(program[p]);
    if (ok)
        memcpy(c->defines, defines, sizeof defines);
    return ok;
}

static bool any_pass(ComputePass pass)
{
    (void)pass;
    return true;
}

static bool programs_create(Compute *c, Error *error)
{
    return compute_programs(c, any_pass, error);
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
    if (!programs_create(c, error) ||
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
    all_defines(c, defines);
    if (!compute_term_buffers(c) || !compute_scratch_fit(c) || !compute_iterate_fit(c))
        return error_set(error, "the GPU has no memory for another term; use a larger spacing");
    if (strcmp(defines, c->defines) != 0 && !programs_create(c, error))
        return false;
    compute_constants(c);
    return true;
}

static bool compute_reload(void *state, Error *error)
{
    return programs_create(state, error);
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
        if (!(k < COMPUTE_FELT - COMPUTE_METHOD && (of || has_shader(pass))))
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
    .feel = compute_feel,
    .felt = compute_felt,
    .gauge = compute_gauge,
    .gauged = compute_gauged,
    .energy = compute_energy,
    .save = compute_save,
    .load = compute_load,
    .info = compute_info,
};
