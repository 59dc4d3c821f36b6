#include "app/setting/settle.h"

#include "sim/matter/flow.h"

#include <math.h>

/* Converts the quaternion to an axis and an angle of at most half a turn. */
static void axis_of(const double q[4], double axis[3], double *angle_deg)
{
    const double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), sign = q[3] < 0 ? -1 : 1;
    *angle_deg = 2 * atan2(sine, sign * q[3]) * (180 / M_PI);
    for (int k = 0; k < 3 && sine > 0; k++)
        axis[k] = sign * q[k] / sine;
}

/* Applies the turn on top of the solid's own turn. */
static void turn(SolidDef *solid, const double by[4])
{
    double rest[4];
    if (solid->kind == SOLID_CYLINDER || solid->kind == SOLID_BOWL) {
        quat_rotate(by, solid->axis, solid->axis);
    } else if (solid->kind != SOLID_SPHERE) {
        solid_turn(solid->axis, solid->angle_deg, rest);
        quat_multiply(by, rest, rest);
        axis_of(rest, solid->axis, &solid->angle_deg);
    }
    for (int i = 0; i < solid->motion_count; i++) /* rotations only: translations stay */
        if (!motion_translates(&solid->motions[i]))
            quat_rotate(by, solid->motions[i].axis, solid->motions[i].axis);
}

static void settle(SolidDef *solid)
{
    const SolidHand *hand = &solid->hand;
    for (int k = 0; k < 3; k++)
        solid->centre[k] += hand->at[k];
    if (hand->turn[0] != 0 || hand->turn[1] != 0 || hand->turn[2] != 0)
        turn(solid, hand->turn);
    solid->hand = (SolidHand){.moved = false};
}

void settle_world(WorldDef *def, uint64_t shut)
{
    for (int i = 0; i < def->solid_count; i++)
        if (def->solids[i].hand.moved)
            settle(&def->solids[i]);
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            def->fluids[f].emits[i].shut = gate_shut(shut, gate_of_emitter(f, i));
    for (int k = 0; k < def->drain_count; k++)
        def->drains[k].shut = gate_shut(shut, gate_of_drain(k));
}
