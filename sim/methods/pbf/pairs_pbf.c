/* The pair loops of pbf: see sim/methods/pbf/pbf.h. */
#include "sim/methods/pbf/pbf_private.h"

#include "sim/methods/shared/pair_incompressible.h"

/* Sums of the number density; `place` has 1 / m. */
PAIR_LOOP(pbf_sums)
{
    density_sums(args, begin, end, pbf_constants(args->constants)->gradient, args->own[SQUARES], NULL);
}

PAIR_LOOP(pbf_solids)
{
    const PbfBlock *own = pbf_constants(args->constants);
    solid_sums(args, begin, end, own->gradient, 1 / own->pressure_of_term, args->own + SOLID,
               args->own[SOLID_FLOW]);
}

/* sum (dk_i + dk_j) F x_ij; `place` has dk. */
PAIR_LOOP(pbf_push)
{
    push_sums(args, begin, end, pbf_constants(args->constants)->gradient);
}

PAIR_LOOP(pbf_friction)
{
    friction_sums(args, begin, end, pbf_constants(args->constants)->friction_gradient);
}
