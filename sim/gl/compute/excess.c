/* What is left of a solver's residual: a pass that adds up, and a wait for its few numbers. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/excess_part.h"

#include <epoxy/gl.h>
#include <math.h>

bool compute_iterates(const Method *method)
{
    const Pass *const *pass = method->passes;
    while (*pass && (*pass)->stage != STAGE_SOLVE)
        pass++;
    return *pass != NULL;
}

bool compute_excess_create(Compute *c)
{
    return !compute_iterates(c->constants->method) ||
           mailbox_create(&c->excess, "excess", COMPUTE_EXCESS_GROUPS * sizeof(ExcessPart));
}

Excess compute_excess(void *state, const ColumnDef *column)
{
    Compute *c = state;
    Excess all = {0};
    glProgramUniform1ui(c->program[COMPUTE_EXCESS], COLUMN_AT, (GLuint)compute_scratch_place(c, column));
    BIND([SCRATCH_BUFFER] = c->scratch, [PARTS_BUFFER] = c->excess.buffer);
    compute_run(c, COMPUTE_EXCESS, (size_t)COMPUTE_EXCESS_GROUPS * COMPUTE_GROUP);
    mailbox_send(&c->excess);
    const ExcessPart *part = mailbox_wait(&c->excess);
    for (int group = 0; part && group < COMPUTE_EXCESS_GROUPS; group++, part++) {
        all.mean += (double)part->above;
        all.greatest = fmaxf(all.greatest, part->greatest);
    }
    all.mean /= c->count > 0 ? (double)c->count : 1;
    return all;
}
