#include "sim/touch/finger.h"

#include <math.h>
#include <string.h>

/* s: a mouse reports positions in jumps of some 10 ms, which the fluid must not feel. */
static const double RESPONSE = 0.03;

/* Maximum of w q, at q^2 = 1/5. */
static const double PEAK = 0.28621670111997307;

bool finger_take(FingerState *state, const Finger *wanted, int dimensions)
{
    const FingerWay way = (FingerWay)wanted->way;
    const bool begins = !finger_on(state);
    if (wanted->way == (double)FINGER_NONE) {
        *state = (FingerState){.point = {0}};
        return true;
    }
    if (!(wanted->way > 0 && wanted->way < FINGER_POUR + FINGER_FLUIDS) || (double)way != wanted->way ||
        !isfinite(wanted->at[0] + wanted->at[1] + wanted->at[2]) || !(wanted->radius > 0) ||
        !isfinite(wanted->radius) || !(wanted->strength >= 0) || !isfinite(wanted->strength) ||
        (finger_fluid(wanted) >= 0 && !(wanted->strength > 0)))
        return false;
    state->wanted = *wanted;
    if (dimensions == 2)
        state->wanted.at[2] = 0;
    if (begins)
        memcpy(state->point, state->wanted.at, sizeof state->point);
    return true;
}

bool finger_sound(const FingerState *state)
{
    FingerState taken = {.point = {0}};
    return finger_take(&taken, &state->wanted, 3) &&
           isfinite(state->point[0] + state->point[1] + state->point[2]);
}

double finger_acceleration(const FingerState *state)
{
    return state->wanted.way == (double)FINGER_PULL || state->wanted.way == (double)FINGER_PUSH
               ? state->wanted.strength
               : 0;
}

/* Follows by an implicit step: stable for every dt, no library function. */
static void follow(FingerState *state, double dt, double moved[3])
{
    const double u = dt / RESPONSE;
    for (int k = 0; k < 3; k++) {
        moved[k] = (state->wanted.at[k] - state->point[k]) * u / (1 + u);
        state->point[k] += moved[k];
    }
}

void finger_step(FingerState *state, const FingerLimits *limits, double dt, FingerStep *step)
{
    const Finger *wanted = &state->wanted;
    double moved[3];
    *step = (FingerStep){.on = false};
    if (!finger_on(state))
        return;
    follow(state, dt, moved);
    step->on = finger_fluid(wanted) < 0;
    const double speed = sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]) / dt;
    const double slower = speed > limits->speed ? limits->speed / speed : 1;
    for (int k = 0; k < 3; k++) {
        step->at[k] = (float)(state->point[k] - 0.5 * moved[k]);
        step->velocity[k] = (float)(slower * moved[k] / dt);
    }
    step->radius = (float)wanted->radius;
    step->inverse_radius2 = (float)(1 / (wanted->radius * wanted->radius));
    const double gain = fmin(wanted->strength * dt, limits->gain) / (PEAK * wanted->radius);
    if (wanted->way == (double)FINGER_STIR)
        step->grip = (float)fmin(wanted->strength * dt, 1e6);
    else
        step->kick = (float)(wanted->way == (double)FINGER_PUSH ? gain : -gain);
}
