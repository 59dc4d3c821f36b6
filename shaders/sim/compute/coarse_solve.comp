// The coarse level: solves for the nodes' values by conjugate gradients, with the diagonal as preconditioner: assemble and solve of
// sim/cpu/coarse.c. A single group.
#include "shaders/sim/constant_block.h"
#include "sim/coarse.glsl"
#include "shaders/sim/solve_block.h"
#include "common/nan.glsl"
layout(local_size_x = COARSE_SOLVE_LANES) in;
layout(std430, binding = COARSE_CELLS_BUFFER) readonly buffer CoarseCells { float cell_of_level[]; };
layout(std430, binding = COARSE_NODES_BUFFER) coherent buffer CoarseNodes { float node[]; };
shared float sums[COARSE_SOLVE_LANES];

const int nodes = COARSE_ALONG.x * COARSE_ALONG.y * COARSE_ALONG.z, cells = COARSE_COUNT.x * COARSE_COUNT.y * COARSE_COUNT.z;
#define AT(array, k) node[(array) * nodes + (k)]
#define EACH(k, count) for (int k = int(gl_LocalInvocationID.x); k < count; k += COARSE_SOLVE_LANES)
#define EACH_NODE(k) EACH(k, nodes) if (AT(COARSE_NODE_INVERSE, k) > 0.0)

// The sum over all invocations.
float total(float found)
{
    uint own = gl_LocalInvocationID.x;
    barrier();
    sums[own] = found;
    for (uint half_count = COARSE_SOLVE_LANES / 2u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count)
            sums[own] += sums[own + half_count];
    }
    barrier();
    return sums[0];
}

bool is_thin()
{
    float weight = 0.0, hold = 0.0;
    EACH(k, cells) {
        weight += cell_of_level[k * COARSE_CELL_FLOATS + COARSE_CELL_WEIGHT];
        hold += cell_of_level[k * COARSE_CELL_FLOATS + COARSE_CELL_HOLD];
    }
    weight = total(weight);
    hold = total(hold);
    return is_nan(hold) || hold >= COARSE_THIN * weight;
}

ivec3 corner_of(int corner) { return ivec3(corner) >> ivec3(0, 1, 2) & 1; }

// False outside of the box. Sides with as many nodes as cells are periodic.
bool inside(inout ivec3 at, ivec3 count)
{
    for (int a = 0; a < 3; a++) {
        if (COARSE_ALONG[a] == COARSE_COUNT[a])
            at[a] = at[a] < 0 ? at[a] + count[a] : at[a] < count[a] ? at[a] : at[a] - count[a];
        if (at[a] < 0 || at[a] >= count[a])
            return false;
    }
    return true;
}

ivec3 place_of(int k)
{
    int row = k / COARSE_ALONG.x;
    return ivec3(k % COARSE_ALONG.x, row % COARSE_ALONG.y, row / COARSE_ALONG.y);
}

// Residual, and the row of the matrix by the 27 nodes around.
void assemble(int k)
{
    float row[27], residual = 0.0;
    for (int n = 0; n < 27; n++)
        row[n] = 0.0;
    for (int a = 0; a < COARSE_CORNERS; a++) {
        ivec3 cell = place_of(k) - corner_of(a);
        if (!inside(cell, COARSE_COUNT))
            continue;
        int from = coarse_number(cell, COARSE_COUNT) * COARSE_CELL_FLOATS;
        residual += cell_of_level[from + COARSE_CELL_RESIDUALS + a];
        for (int b = 0; b < COARSE_CORNERS; b++) {
            ivec3 way = corner_of(b) - corner_of(a) + 1;
            row[way.x + 3 * way.y + 9 * way.z] += cell_of_level[from + COARSE_CORNERS * a + b];
        }
    }
    for (int n = 0; n < 27; n++)
        AT(COARSE_NODE_STENCIL + n, k) = row[n];
    float inverse = row[13] > 0.0 ? 1.0 / row[13] : 0.0;
    AT(COARSE_NODE_VALUE, k) = 0.0;
    AT(COARSE_NODE_RESIDUAL, k) = residual;
    AT(COARSE_NODE_INVERSE, k) = inverse;
    AT(COARSE_NODE_DIRECTION, k) = inverse * residual;
}

// Matrix times direction.
float bent(int k)
{
    float found = 0.0;
    for (int n = 0; n < 27; n++) {
        ivec3 at = place_of(k) + ivec3(n % 3, n / 3 % 3, n / 9) - 1;
        if (inside(at, COARSE_ALONG))
            found += AT(COARSE_NODE_STENCIL + n, k) * AT(COARSE_NODE_DIRECTION, coarse_number(at, COARSE_ALONG));
    }
    return found;
}

float power_of()
{
    float found = 0.0;
    EACH_NODE(k) found += AT(COARSE_NODE_RESIDUAL, k) * AT(COARSE_NODE_RESIDUAL, k) * AT(COARSE_NODE_INVERSE, k);
    return total(found);
}

void main()
{
    bool thin = is_thin();
    EACH(k, nodes) assemble(k);
    memoryBarrierBuffer();
    if (thin) {
        coarse = 0u;
        return;
    }
    float power = power_of(), enough = COARSE_LEFT * COARSE_LEFT * power;
    for (int done = 0; power > enough && done < COARSE_ITERATIONS_MOST; done++) {
        float curvature = 0.0;
        EACH_NODE(k)
        {
            AT(COARSE_NODE_BENT, k) = bent(k);
            curvature += AT(COARSE_NODE_DIRECTION, k) * AT(COARSE_NODE_BENT, k);
        }
        curvature = total(curvature);
        float go = curvature > 0.0 ? power / curvature : 0.0, before = power;
        EACH_NODE(k)
        {
            AT(COARSE_NODE_VALUE, k) += go * AT(COARSE_NODE_DIRECTION, k);
            AT(COARSE_NODE_RESIDUAL, k) -= go * AT(COARSE_NODE_BENT, k);
        }
        power = go > 0.0 ? power_of() : 0.0;
        EACH_NODE(k) AT(COARSE_NODE_DIRECTION, k) = AT(COARSE_NODE_INVERSE, k) * AT(COARSE_NODE_RESIDUAL, k) + power / before * AT(COARSE_NODE_DIRECTION, k);
        memoryBarrierBuffer();
        barrier();
    }
}
