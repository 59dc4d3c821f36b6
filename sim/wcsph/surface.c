/* Normals of free surfaces and interfaces. */
#include "sim/wcsph/passes.h"

PAIR_LOOPS(wcsph_normals);

static void normals_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_normals);
    wcsph_join_few(range);
}

static const CpuPass normals = {.loops = {{normals_body, .walks = true}, {wcsph_join}}};

const Pass wcsph_surface = {
    .name = "surface",
    .stage = STAGE_FORCE,
    .cpu = &normals,
    .shader = "wcsph/surface",
    .reads = "position kind",
    .writes = "outward drop",
    .needed = wcsph_curves,
};
