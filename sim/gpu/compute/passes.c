/* What each file of the backend stands on: passes and buffers by number, binding, and running a pass. */
#include "sim/gpu/compute/compute.h"

#include "shaders/shared/scan.h"
#include "shaders/sim/bindings.h"
#include "shaders/sim/exact_shapes_block.h"
#include "shaders/sim/mesh_block.h"
#include "shaders/sim/solid_steps_block.h"
#include "sim/gpu/gl.h"

#include <assert.h>
#include <epoxy/gl.h>

/* ---- passes, buffers and scratch columns for shaders: of the method, then of the shared terms ---- */

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

bool compute_pass_needed(const Constants *s, int k)
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

size_t compute_scratch_place(const Compute *c, const ColumnDef *column)
{
    const ComputeScratch scratch = compute_scratch_of(c->constants);
    size_t place = 0;
    for (int k = 0; k < scratch.count && scratch.row[k] != column; k++)
        place += (size_t)scratch.row[k]->components * c->capacity;
    return place;
}

bool compute_iterates(const Constants *s)
{
    const Term *of;
    const Pass *pass;
    bool solves = false;
    for (int k = 0; (pass = compute_pass_at(s->method, k, &of)); k++)
        solves |= pass->stage == STAGE_SOLVE && (!of || of->needed(s));
    return solves;
}

/* ---- making, binding and running ---- */

bool compute_no_memory(const Compute *c, Error *error)
{
    return error_set(error, "the GPU has no memory for %zu particles and %zu cells; use a larger spacing",
                     c->count, c->fold.count);
}

unsigned compute_buffer_of(Compute *c, const char *label, size_t bytes, const void *contents)
{
    GLuint name;
    const size_t size = bytes > 0 ? bytes : 16;
    glCreateBuffers(1, &name);
    glObjectLabel(GL_BUFFER, name, -1, label);
    glNamedBufferStorage(name, (GLsizeiptr)size, bytes > 0 ? contents : NULL, GL_DYNAMIC_STORAGE_BIT);
    const bool none = gl_errors_take(GL_OUT_OF_MEMORY) > 0;
    c->full |= none;
    if (none) { /* a name without storage would be taken for a buffer */
        glDeleteBuffers(1, &name);
        return 0;
    }
    c->bytes += size;
    return name;
}

unsigned compute_buffer(Compute *c, const char *label, size_t bytes)
{
    const unsigned name = compute_buffer_of(c, label, bytes, NULL);
    if (!name)
        return 0;
    glClearNamedBufferData(name, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    glFinish(); /* NVIDIA 580: no barrier keeps a clear before a later glNamedBufferSubData */
    return name;
}

static void bind(int binding, unsigned buffer)
{
    if (binding >= 0 && buffer)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)binding, buffer);
}

void compute_bind(const unsigned *buffers, int count)
{
    for (int k = 0; k < count; k++)
        bind(k, buffers[k]);
}

/* Dispatches work groups in rows: shaders/sim/constants.glsl. */
static void dispatch(size_t groups)
{
    const size_t rows = (groups + COMPUTE_ALONG - 1) / COMPUTE_ALONG;
    glDispatchCompute((GLuint)(rows > 1 ? COMPUTE_ALONG : groups), (GLuint)rows, 1);
}

static void bind_blocks(Compute *c)
{
    enum { FIRST = CONSTANT_BLOCK }; /* first of five consecutive blocks */
    const GLuint blocks[] = {[CONSTANT_BLOCK - FIRST] = c->constant_block,
                             [STEP_BLOCK - FIRST] = c->step,
                             [TERM_BLOCK - FIRST] = c->terms,
                             [WATCH_BLOCK - FIRST] = c->watch.buffer,
                             [METHOD_BLOCK - FIRST] = c->of_method};
    glBindBuffersBase(GL_UNIFORM_BUFFER, FIRST, sizeof blocks / sizeof *blocks, blocks);
}

/* Offset in SolveBlock of a solver's number of work groups; -1: the caller's number counts. */
static GLintptr decided_at(const Compute *c, ComputePass pass)
{
    const bool renews = c->decided == DECIDED_RENEWAL;
    if (c->decided == DECIDED_NONE)
        return -1;
    if (pass == COMPUTE_EXCESS)
        return (GLintptr)(renews ? offsetof(SolveBlock, renewal_sum_groups)
                                 : offsetof(SolveBlock, sum_groups));
    if (pass == COMPUTE_DECIDE)
        return (GLintptr)(renews ? offsetof(SolveBlock, renewal_decision_groups)
                                 : offsetof(SolveBlock, decision_groups));
    if (renews)
        return offsetof(SolveBlock, renewal_groups);
    if (c->decided == DECIDED_CORRECTION)
        return (GLintptr)(pass == COMPUTE_COARSE_SUM     ? offsetof(SolveBlock, coarse_cell_groups)
                          : pass == COMPUTE_COARSE_SOLVE ? offsetof(SolveBlock, coarse_solve_groups)
                                                         : offsetof(SolveBlock, coarse_groups));
    return pass >= COMPUTE_METHOD ? (GLintptr)offsetof(SolveBlock, pass_groups) : -1;
}

/* Dispatches the groups, or the number in SolveBlock: for a renewal the largest number of any pass. */
static void dispatch_decided(Compute *c, ComputePass pass, size_t groups)
{
    const GLintptr decided = decided_at(c, pass);
    if (decided < 0) {
        dispatch(groups);
        return;
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, c->solve);
    glDispatchComputeIndirect(decided);
}

/* True if particles stay as they are. */
static bool only_reads(ComputePass pass)
{
    return pass == COMPUTE_ENERGY || pass == COMPUTE_GAUGE || pass == COMPUTE_SHOW ||
           pass == COMPUTE_FORCES_SUM || pass == COMPUTE_COPY || pass == COMPUTE_CLEAR;
}

void compute_run(Compute *c, ComputePass pass, size_t count)
{
    c->summed &= only_reads(pass);
    const bool watched = pass == COMPUTE_KICK || pass == COMPUTE_DRIFT;
    bind_blocks(c);
    glUseProgram(c->program[pass]);
    dispatch_decided(c, pass, (count + COMPUTE_GROUP - 1) / COMPUTE_GROUP);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | (watched ? GL_UNIFORM_BARRIER_BIT : 0));
}

/* Runs a pass over numbers of 4 bytes: clear.comp, copy.comp. */
static void run_words(Compute *c, ComputePass pass, size_t bytes, size_t from, size_t to)
{
    enum { WORDS = 4 }; /* an invocation's */
    const size_t words = bytes / 4, per_group = (size_t)WORDS * COMPUTE_GROUP;
    if (words == 0)
        return;
    glProgramUniform3ui(c->program[pass], WORDS_AT, (GLuint)words, (GLuint)(from / 4), (GLuint)(to / 4));
    compute_run(c, pass, (words + per_group - 1) / per_group * COMPUTE_GROUP);
}

void compute_clear(Compute *c, unsigned buffer, size_t bytes)
{
    BIND([CLEARED_BUFFER] = buffer);
    run_words(c, COMPUTE_CLEAR, bytes, 0, 0);
}

void compute_copy(Compute *c, unsigned from, unsigned to, size_t at, size_t bytes)
{
    BIND([CLEARED_BUFFER] = to, [COPIED_BUFFER] = from);
    run_words(c, COMPUTE_COPY, bytes, at, at);
}

static void meshes_bind(const Compute *c)
{
    if (!c->meshes.texture)
        return;
    glBindBufferBase(GL_UNIFORM_BUFFER, MESH_BLOCK, c->meshes.block);
    glBindTextureUnit(MESH_VALUES_TEXTURE, c->meshes.texture);
}

void compute_boundary_bind(Compute *c)
{
    const ComputeBoundary *b = &c->boundary;
    if (c->constants->solid_count == 0)
        return;
    BIND([BOUNDARY_POSITIONS_BUFFER] = b->position, [BOUNDARY_VELOCITIES_BUFFER] = b->velocity,
         [BOUNDARY_STATES_BUFFER] = b->state, [BOUNDARY_STARTS_BUFFER] = b->start);
    glBindBufferBase(GL_UNIFORM_BUFFER, SOLID_STEPS_BLOCK, b->block);
    glBindBufferBase(GL_UNIFORM_BUFFER, EXACT_SHAPES_BLOCK, b->exact);
    meshes_bind(c);
}

/* Passes find the state's buffers by the names of storage blocks: a block declared in a shader is bound at
   its declared binding. */

static const struct {
    const char *block;
    size_t at; /* offset of the buffer's name in Compute */
} named[COMPUTE_NAMED] = {
    {"Positions", offsetof(Compute, now.position)},
    {"Velocities", offsetof(Compute, now.velocity)},
    {"Names", offsetof(Compute, now.name)},
    {"Pressures", offsetof(Compute, pressure)},
    {"Near", offsetof(Compute, near)},
    {"Accelerations", offsetof(Compute, acceleration)},
    {"Own", offsetof(Compute, now.own)},
    {"Scratch", offsetof(Compute, scratch)},
    {"Starts", offsetof(Compute, start)},
    {"Lists", offsetof(Compute, lists[0])},
    {"Lists1", offsetof(Compute, lists[1])},
    {"Lists2", offsetof(Compute, lists[2])},
    {"Lists3", offsetof(Compute, lists[3])},
    {"DragTables", offsetof(Compute, drag)},
    {"WatchBlock", offsetof(Compute, watch.buffer)},
    {"ForceParts", offsetof(Compute, forces.buffer)},
    {"SolveBlock", offsetof(Compute, solve)},
    {"CoarseTerms", offsetof(Compute, spare.position)}, /* free until the next sort */
    {"CoarseCells", offsetof(Compute, coarse_cells)},
    {"CoarseNodes", offsetof(Compute, coarse_nodes)},
    {"Rests", offsetof(Compute, boundary.rest)},
    {"BoundaryPositions", offsetof(Compute, boundary.position)},
    {"BoundaryVelocities", offsetof(Compute, boundary.velocity)},
    {"BoundaryStates", offsetof(Compute, boundary.state)},
    {"BoundaryStarts", offsetof(Compute, boundary.start)},
};

static int binding_of(GLuint program, const char *block)
{
    const GLuint at = glGetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, block);
    const GLenum what = GL_BUFFER_BINDING;
    GLint binding = -1;
    if (at != GL_INVALID_INDEX)
        glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, at, 1, &what, 1, NULL, &binding);
    assert(binding <= INT8_MAX);
    return binding;
}

void compute_find_buffers(Compute *c, ComputePass pass)
{
    const GLuint program = c->program[pass];
    c->takes_dt[pass] = program && glGetUniformLocation(program, "dt") >= 0;
    for (int k = 0; k < COMPUTE_NAMED; k++)
        c->bindings[pass][k] = (int8_t)(program ? binding_of(program, named[k].block) : -1);
    for (int k = 0; k < COMPUTE_BUFFERS; k++) {
        const ShaderBuffer *own = compute_buffer_at(c->constants, k);
        c->bindings[pass][COMPUTE_NAMED + k] =
            (int8_t)(program && own ? binding_of(program, own->block) : -1);
    }
}

void compute_sweep(Compute *c, ComputePass pass, size_t count)
{
    compute_boundary_bind(c);
    for (int k = 0; k < COMPUTE_NAMED; k++)
        bind(c->bindings[pass][k], *(const unsigned *)(const void *)((const char *)c + named[k].at));
    for (int k = 0; k < COMPUTE_BUFFERS; k++)
        bind(c->bindings[pass][COMPUTE_NAMED + k], c->of_shaders[k]);
    compute_run(c, pass, count);
}

static size_t blocks_of(size_t size)
{
    return (size + COMPUTE_SCAN_BLOCK - 1) / COMPUTE_SCAN_BLOCK;
}

static void run_blocks(Compute *c, ComputePass pass, unsigned values, unsigned totals, size_t size)
{
    BIND([SCAN_VALUES_STORAGE] = values, [SCAN_TOTALS_STORAGE] = totals);
    glUseProgram(c->program[pass]);
    glUniform1ui(SCAN_SIZE_AT, (GLuint)size);
    dispatch_decided(c, pass, blocks_of(size));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void compute_scan(Compute *compute, unsigned buffer, size_t size)
{
    unsigned values[COMPUTE_SCAN_LEVELS + 1] = {buffer};
    size_t sizes[COMPUTE_SCAN_LEVELS + 1] = {size};
    int levels = 0;
    if (size == 0)
        return;
    do {
        run_blocks(compute, COMPUTE_SCAN, values[levels], compute->totals[levels], sizes[levels]);
        values[levels + 1] = compute->totals[levels];
        sizes[levels + 1] = blocks_of(sizes[levels]);
        levels++;
    } while (sizes[levels] > 1 && levels < COMPUTE_SCAN_LEVELS);
    for (int level = levels - 2; level >= 0; level--)
        run_blocks(compute, COMPUTE_SCAN_ADD, values[level], values[level + 1], sizes[level]);
}
