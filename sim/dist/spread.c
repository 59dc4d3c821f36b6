/* Sends a state read from a file from the first rank to all ranks. */
#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"

#include <string.h>

/* Sends in pieces, since MPI counts in int. */
static void spread_bytes(void *bytes, size_t size)
{
    static const size_t PIECE = 1 << 30;
    for (size_t at = 0; at < size; at += PIECE)
        MPI_Bcast((char *)bytes + at, (int)(size - at < PIECE ? size - at : PIECE), MPI_BYTE, 0,
                  MPI_COMM_WORLD);
}

void ranks_spread(WorldState *state, const WorldDef *def)
{
    const ColumnRows saved = columns_saved(def);
    int rank;
    size_t counts[2] = {state->count, state->births.count};
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    spread_bytes(counts, sizeof counts);
    if (rank > 0 &&
        (!world_state_reserve(state, def, counts[0]) || !births_reserve(&state->births, counts[1])))
        dist_die("no memory for the state of %zu particles", counts[0]);
    spread_bytes(&state->numbers, sizeof state->numbers);
    state->births.count = counts[1];
    spread_bytes(state->births.of, counts[1] * sizeof *state->births.of);
    for (int r = 0; r < saved.count; r++)
        for (int c = 0; c < saved.row[r]->components; c++)
            spread_bytes(*column_array(&state->particles, saved.row[r], c),
                         counts[0] * column_size(saved.row[r]));
}
