/* The programs of the passes, made of lines of every part of the state. */
#include "sim/gpu/compute/compute.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <string.h>

static const char *const pass_names[] = {
#define X(NAME, name) name,
    COMPUTE_PASSES(X)
#undef X
};

/* Parts of work groups over all particles: per group, for the box and each solid. */
size_t compute_group_parts(const Compute *c)
{
    return (c->capacity + COMPUTE_GROUP - 1) / COMPUTE_GROUP * (size_t)(1 + c->constants->solid_count);
}

bool compute_changes_with_forces(ComputePass pass)
{
    return pass == COMPUTE_KICK || pass == COMPUTE_DRIFT || pass == COMPUTE_FORCES_SUM ||
           pass >= COMPUTE_FORCES;
}

static void forces_defines(const Compute *c, ComputePass pass, char out[COMPUTE_DEFINES_MAX])
{
    const size_t used = strlen(out);
    if (c->forces.to)
        snprintf(out + used, COMPUTE_DEFINES_MAX - used,
                 "#define FORCES%s 1\n#define FORCES_OF_GROUP %du\n#define FORCES_BOUNDARY %zuu\n"
                 "#define FORCES_BOUNDARY_COUNT %zuu\n",
                 pass < COMPUTE_FORCES ? "" : "_ON_SOLIDS", 1 + c->constants->solid_count,
                 compute_group_parts(c), c->constants->boundary.count);
}

typedef struct PassSource {
    const char *label;
    char path[64], defines[COMPUTE_DEFINES_MAX];
} PassSource;

/* Index of the pass among the method's passes, then the terms' passes, for the shader of `pass`. */
static int of_method(ComputePass pass)
{
    return (int)pass - (pass < COMPUTE_FORCES ? COMPUTE_METHOD : COMPUTE_FORCES);
}

static PassSource source_of(const Compute *c, ComputePass pass, const char *defines)
{
    const Term *of;
    PassSource source = {.label = pass < COMPUTE_METHOD
                                      ? pass_names[pass]
                                      : compute_pass_at(c->constants->method, of_method(pass), &of)->shader};
    snprintf(source.path, sizeof source.path, "sim/%s.comp", source.label);
    snprintf(source.defines, sizeof source.defines, "%s", defines);
    if (compute_changes_with_forces(pass))
        forces_defines(c, pass, source.defines);
    return source;
}

unsigned compute_program(const Compute *c, ComputePass pass, const char *defines, Error *error)
{
    const PassSource source = source_of(c, pass, defines);
    return program_create(source.label, (const char *const[]){source.path, NULL}, source.defines, error);
}

static bool finished(const Compute *c, ComputePass pass, unsigned program, const char *defines, Error *error)
{
    const PassSource source = source_of(c, pass, defines);
    return program_finish(program, source.label, (const char *const[]){source.path, NULL}, source.defines,
                          error);
}

static unsigned begun(const Compute *c, ComputePass pass, const char *defines, Error *error)
{
    const PassSource source = source_of(c, pass, defines);
    return program_begin(source.label, (const char *const[]){source.path, NULL}, source.defines, error);
}

/* True if the pass needs a program: the scene's terms need the pass, or the pass was requested. */
static bool pass_wanted(const Compute *c, ComputePass pass)
{
    const Term *of;
    if (pass >= COMPUTE_METHOD && !compute_pass_needed(c->constants, of_method(pass)))
        return false;
    if (pass >= COMPUTE_FORCES)
        return c->forces.to && c->constants->solid_count > 0 &&
               compute_pass_at(c->constants->method, of_method(pass), &of)->acts_on_solids;
    if (pass >= COMPUTE_METHOD)
        return true;
    if (pass == COMPUTE_FORCES_SUM)
        return c->forces.to;
    if (pass == COMPUTE_OWN_MOVE || pass == COMPUTE_OWN_GATHER)
        return c->own.count > 0;
    return pass == COMPUTE_GAUGE || pass == COMPUTE_ENERGY ? c->program[pass] != 0
                                                           : compute_pass_named(c->constants, pass);
}

void compute_all_defines(const Compute *c, char out[COMPUTE_DEFINES_MAX])
{
    compute_defines(c->constants, out);
    compute_own_defines(c, out);
    compute_list_defines(c, out);
    compute_coarse_defines(c->constants, out);
}

bool compute_programs(Compute *c, bool (*which)(ComputePass pass), Error *error)
{
    char defines[COMPUTE_DEFINES_MAX];
    unsigned program[COMPUTE_PASS_COUNT] = {0};
    bool ok = true;
    compute_all_defines(c, defines);
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

bool compute_programs_create(Compute *c, Error *error)
{
    return compute_programs(c, any_pass, error);
}
