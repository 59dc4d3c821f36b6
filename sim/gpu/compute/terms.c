/* Optional terms of scenes: lines before the shaders, uniforms and buffers. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/term_block.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t put_define(char out[COMPUTE_DEFINES_MAX], size_t used, const char *name)
{
    return used + (size_t)snprintf(out + used, COMPUTE_DEFINES_MAX - used, "#define %s 1\n", name);
}

static bool has_meshes(const Constants *s)
{
    for (int k = 0; k < s->solid_count; k++)
        if (s->solids[k].kind == SOLID_MESH)
            return true;
    return false;
}

static size_t put_defines(const Constants *s, const ShaderTerm *terms, char out[COMPUTE_DEFINES_MAX],
                          size_t used)
{
    for (; terms && terms->name; terms++)
        if (terms->needed(s))
            used = put_define(out, used, terms->name);
    return used;
}

void compute_defines(const Constants *s, char out[COMPUTE_DEFINES_MAX])
{
    const struct {
        bool named;
        const char *name;
    } terms[] = {
        {s->solid_count > 0, "SOLIDS"},
        {has_meshes(s), "MESHES"},
        {s->reproducible, "REPRODUCIBLE"},
        {s->fluid_count == 1, "ONE_FLUID"},
        {s->holds, "HOLDS"},
        {s->rubs, "RUBS"},
        {s->negative_pressure, "NEGATIVE_PRESSURE"},
        {s->method->carries_density, "CARRIES_DENSITY"},
        {s->tension_model == TENSION_COLOUR_FIELD || s->tension_model == TENSION_COHESION, "TENSION"},
        {s->tension_model == TENSION_COHESION, "COHESION"},
        {s->no_slip, "NO_SLIP"},
        {s->lid, "LID"},
        {s->method->leaps, "LEAPS"},
        {s->wide, "WIDE"},
    };
    size_t used = 0;
    if (s->periodic.any)
        used += (size_t)snprintf(out, COMPUTE_DEFINES_MAX, "#define PERIODIC bvec3(%d, %d, %d)\n",
                                 s->periodic.axis[0], s->periodic.axis[1], s->periodic.axis[2]);
#define X(NAME, name, unit)                                                                                  \
    used += (size_t)snprintf(out + used, COMPUTE_DEFINES_MAX - used, "#define SCALAR_" #NAME " %d\n",        \
                             SCALAR_##NAME);
    STATE_SCALAR_LIST(X)
    X(STATE_COUNT, , )
#undef X
    for (size_t k = 0; k < sizeof terms / sizeof *terms; k++)
        if (terms[k].named)
            used = put_define(out, used, terms[k].name);
    used = put_defines(s, s->method->terms, out, used);
    for (const Term *const *term = shared_terms; *term; term++)
        used = put_defines(s, (*term)->terms, out, used);
    if (s->method->energy_shader)
        snprintf(out + used, COMPUTE_DEFINES_MAX - used, "#define ENERGY_OF_METHOD sim/%s.glsl\n",
                 s->method->energy_shader);
}

CoarseShape compute_coarse_shape(const Constants *s)
{
    enum { CELLS_MOST = 1 << 16 }; /* fewer than on the CPU: a single work group solves for the nodes */
    return coarse_shape(s, CELLS_MOST);
}

bool compute_corrects(const Constants *s)
{
    for (const Pass *const *pass = s->method->passes; *pass; pass++)
        if ((*pass)->corrects && (!(*pass)->needed || (*pass)->needed(s)))
            return true;
    return false;
}

void compute_coarse_defines(const Constants *s, char out[COMPUTE_DEFINES_MAX])
{
    const CoarseShape shape = compute_coarse_shape(s);
    const size_t used = strlen(out);
    const int *inner = shape.inner, *count = shape.count, *along = shape.along;
    if (compute_corrects(s))
        snprintf(out + used, COMPUTE_DEFINES_MAX - used,
                 "#define COARSE_INNER ivec3(%d, %d, %d)\n#define COARSE_COUNT ivec3(%d, %d, %d)\n"
                 "#define COARSE_ALONG ivec3(%d, %d, %d)\n#define COARSE_WIDE %d\n",
                 inner[0], inner[1], inner[2], count[0], count[1], count[2], along[0], along[1], along[2],
                 shape.wide);
}

bool compute_pass_named(const Constants *s, ComputePass pass)
{
    switch (pass) {
    case COMPUTE_SORT:
        return s->reproducible;
    case COMPUTE_BOUNDARY_BIN:
    case COMPUTE_BOUNDARY_PLACE:
    case COMPUTE_BOUNDARY_SORT:
    case COMPUTE_BOUNDARY_FILL:
        return s->solid_count > 0;
    case COMPUTE_EXCESS:
    case COMPUTE_DECIDE:
    case COMPUTE_RENEW:
        return compute_iterates(s);
    case COMPUTE_COARSE_SUM:
    case COMPUTE_COARSE_SOLVE:
    case COMPUTE_COARSE_ADD:
        return compute_corrects(s);
    case COMPUTE_GUIDE:
    case COMPUTE_EMIT_MARK:
    case COMPUTE_EMIT_ADD:
        return s->emits;
    case COMPUTE_FLOW_COUNT:
        return s->emits || s->drains;
    case COMPUTE_DRAIN_MARK:
    case COMPUTE_DRAIN_GATHER:
        return s->drains;
    default:
        return true;
    }
}

/* Number of entries in the tables of t + 1 faces. */
static size_t drag_entries(const WallDrag *drag, int t)
{
    size_t entries = 1;
    for (int k = 0; k <= t; k++)
        entries *= (size_t)drag->nodes[t];
    return entries;
}

static void drag_upload(Compute *c)
{
    const WallDrag *drag = &c->constants->drag;
    size_t all = 0, at = 0;
    for (int t = 0; t < drag->dimensions; t++)
        all += drag_entries(drag, t);
    float *tables = malloc((all + 1) * sizeof *tables);
    c->full |= !tables;
    for (int t = 0; tables && t < drag->dimensions; at += drag_entries(drag, t++))
        memcpy(tables + at, drag->table[t], drag_entries(drag, t) * sizeof *tables);
    if (tables)
        c->drag = compute_buffer_of(c, "tables of the walls' friction", all * sizeof *tables, tables);
    free(tables);
}

bool compute_term_buffers(Compute *c)
{
    const Constants *s = c->constants;
    for (int k = 0; k < COMPUTE_BUFFERS; k++) {
        const ShaderBuffer *own = compute_buffer_at(s, k);
        if (own && own->needed(s) && !c->of_shaders[k])
            c->of_shaders[k] = compute_buffer(c, own->block, own->size * c->capacity);
    }
    if (s->no_slip && !c->drag)
        drag_upload(c);
    const bool all = !c->full;
    c->full = false; /* the world can go on without */
    return all;
}

static void drag_constants(const WallDrag *drag, TermBlock *terms)
{
    size_t offset = 0;
    for (int t = 0; t < drag->dimensions; t++) {
        terms->drag_nodes[t] = drag->nodes[t];
        terms->drag_steps[t] = drag->inverse_step[t];
        terms->drag_offset[t] = (int)offset;
        offset += drag_entries(drag, t);
    }
    terms->drag_range = drag->range;
}

static void uniforms(unsigned *buffer, const void *values, size_t size)
{
    if (!*buffer) {
        glCreateBuffers(1, buffer);
        glNamedBufferStorage(*buffer, (GLsizeiptr)size, NULL, GL_DYNAMIC_STORAGE_BIT);
    }
    glNamedBufferSubData(*buffer, 0, (GLsizeiptr)size, values);
}

void compute_term_constants(Compute *c)
{
    const Constants *s = c->constants;
    TermBlock terms = {.colour_scale = s->colour, .friction_scale = s->implicit.scale};
    for (int f = 0; f < s->fluid_count; f++)
        terms.fluid_terms[f] = (FluidTerms){s->tension[f], s->wet[f]};
    terms.curvature_least = CURVATURE_LEAST / 100.0F;
    terms.curvature_whole = CURVATURE_WHOLE / 100.0F;
    terms.curvature_full = s->curvature.full;
    terms.curvature_crowd_least = CROWD_LEAST;
    terms.curvature_few = s->curvature.few;
    terms.curvature_crowd = s->curvature.crowd;
    terms.curvature_offset = s->curvature.offset;
    terms.curvature_most = s->curvature.most;
    if (s->no_slip)
        drag_constants(&s->drag, &terms);
    memcpy(terms.lid_velocity, s->lid_velocity, sizeof s->lid_velocity);
    uniforms(&c->terms, &terms, sizeof terms);
    uniforms(&c->of_method, s->of_method, sizeof s->of_method);
}
