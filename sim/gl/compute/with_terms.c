/* Passes, buffers and scratch columns for shaders: of the method, then of the shared terms. */
#include "sim/gl/compute/compute.h"

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
