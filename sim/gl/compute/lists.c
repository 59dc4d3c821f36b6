/* Neighbour lists, made by the first pass of a step for later passes: shaders/sim/lists.glsl. Without a
   free binding or memory, and with periodic sides, each pass walks the cells. Lists take at most a quarter
   of the memory: the views need some, and a driver may promise more memory than there is. */
#include "sim/gl/compute/compute.h"
#include "sim/gl/limits.h"

#include "shaders/sim/bindings.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* List size: half more than the lattice has within the support, plus 8, since moving fluid is locally
   denser. */
static size_t list_most(const Constants *s)
{
    const double r = (double)s->support_radius / (double)s->spacing, pi = 3.14159265358979;
    const double lattice = s->dimensions == 2 ? pi * r * r : 4.0 / 3.0 * pi * r * r * r;
    return 8 * (size_t)ceil((1.5 * lattice + 8) / 8);
}

/* Rounded up to blocks of 32 particles. */
static size_t stride_of(const Compute *c)
{
    return (c->capacity + 31) / 32 * 32;
}

/* True if the driver has enough bindings and blocks: solids and a method's columns need some beside the
   usual eight. */
static bool bound(const Compute *c, const GlLimits *have)
{
    const int columns = (c->own.count > 0) + (compute_scratch_of(c->constants).total > 0);
    return !c->constants->periodic.any && have->bindings > LISTS_BUFFER &&
           have->compute_blocks >= 8 + columns + (c->constants->solid_count > 0 ? 5 : 0);
}

void compute_lists_create(Compute *c)
{
    const GlLimits have = gl_limits();
    const size_t most = list_most(c->constants), bytes = 4 * (most + 1) * stride_of(c);
    if (c->full || !bound(c, &have))
        return;
    if ((int64_t)bytes <= have.block_bytes && (double)bytes <= 0.25 * gl_memory())
        c->lists = compute_buffer(c, "lists of neighbours", bytes);
    c->list_most = most;
    c->full = false;
    c->unlisted = c->lists ? 0 : bytes;
}

void compute_list_defines(const Compute *c, char out[COMPUTE_DEFINES_MAX])
{
    const size_t used = strlen(out);
    if (c->lists)
        snprintf(out + used, COMPUTE_DEFINES_MAX - used,
                 "#define LISTS 1\n#define LIST_MOST %zuu\n#define LIST_STRIDE %zuu\n", c->list_most,
                 stride_of(c));
}
