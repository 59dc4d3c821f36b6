#include "forms.h"
#include "sim/cpu/pairs.h"

PAIR_LOOPS(lists);
PAIR_LOOPS(mueller_density);
PAIR_LOOPS(mueller_force);

void program_lists(Cloud *cloud)
{
    const size_t count = cloud->args.count;
    for (size_t begin = 0; begin < count; begin += LISTS_GRAIN)
        lists.in[PAIR_AVX2](&cloud->making, begin, begin + LISTS_GRAIN < count ? begin + LISTS_GRAIN : count);
}

void program_density(Cloud *cloud)
{
    mueller_density.in[PAIR_AVX2](&cloud->args, 0, cloud->args.count);
}

void program_force(Cloud *cloud)
{
    mueller_force.in[PAIR_AVX2](&cloud->args, 0, cloud->args.count);
}
