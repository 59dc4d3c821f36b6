#include "sim/matter/forces.h"

void push_add(Push *to, double times, const Push *push)
{
    for (int k = 0; k < 3; k++) {
        to->force[k] += times * push->force[k];
        to->torque[k] += times * push->torque[k];
    }
}

void push_about(Push *push, const double to[3])
{
    const double none[3] = {0}, from[3] = {-to[0], -to[1], -to[2]};
    double force[3];
    for (int k = 0; k < 3; k++)
        force[k] = push->force[k];
    push_at(push, from, force);
    push_at(push, none, (double[3]){-force[0], -force[1], -force[2]});
}

void forces_add(Forces *to, const Forces *sum)
{
    to->seconds += sum->seconds;
    push_add(&to->box, 1, &sum->box);
    for (int k = 0; k < SOLIDS_MAX; k++)
        push_add(&to->solid[k], 1, &sum->solid[k]);
}

void forces_add_mean(Forces *to, const Forces *mean)
{
    to->seconds += mean->seconds;
    push_add(&to->box, mean->seconds, &mean->box);
    for (int k = 0; k < SOLIDS_MAX; k++)
        push_add(&to->solid[k], mean->seconds, &mean->solid[k]);
}

static void scale(Push *push, double factor)
{
    for (int k = 0; k < 3; k++) {
        push->force[k] *= factor;
        push->torque[k] *= factor;
    }
}

void forces_mean(Forces *forces)
{
    const double factor = forces->seconds > 0 ? 1 / forces->seconds : 0;
    scale(&forces->box, factor);
    for (int k = 0; k < SOLIDS_MAX; k++)
        scale(&forces->solid[k], factor);
}
