/* A user's finger in the fluid: stirs, pulls or pushes in a ball around a point, or pours fluid from a disk
   (sim/world/world_flow.c). The point follows the user's input in simulated time; without a finger there is
   no pass and no branch.

   With q = |x - point| / radius and w = (1 - q^2)^2 inside, 0 outside, over a step of dt:
     stir: v += (1 - exp(-strength w dt)) (V - v), exact for a fixed w, so never overshoots;
     pull, push: v -+= strength dt w q / max(w q) along x - point, so that the centre feels nothing. */
#ifndef SLOSH_FINGER_H
#define SLOSH_FINGER_H

#include <stdbool.h>

typedef enum FingerWay {
    FINGER_NONE,
    FINGER_STIR,
    FINGER_PULL,
    FINGER_PUSH,
    FINGER_POUR, /* pours the first fluid; the next numbers pour further fluids */
    FINGER_WAYS
} FingerWay;

enum { FINGER_FLUIDS = 8 };

/* The user's input. Doubles only, as in all of the saved state. */
typedef struct Finger {
    double way;      /* a FingerWay; for pouring FINGER_POUR plus the number of the fluid */
    double at[3];    /* box's frame, m */
    double radius;   /* of the ball or disk, m */
    double strength; /* stir: 1/s; pull, push: greatest acceleration of a particle, m/s2; pour: speed, m/s */
} Finger;

/* Zero: no finger. */
typedef struct FingerState {
    Finger wanted;
    double point[3]; /* present position, box's frame, m */
} FingerState;

/* The finger in a step. Zero: no effect on present fluid. */
typedef struct FingerStep {
    bool on;
    float at[3], velocity[3];      /* at the middle of the step, m; of the point, m/s */
    float radius, inverse_radius2; /* m, 1/m2 */
    float grip;                    /* stir: strength dt */
    float kick;                    /* pull, push: velocity gain per metre from the point at w = 1, 1/s */
} FingerStep;

/* Bounds of a step's effect on a particle. */
typedef struct FingerLimits {
    double speed; /* of the point, m/s: the sentinel treats faster particles as trouble */
    double gain;  /* by pull and push in a step, m/s */
} FingerLimits;

/* Takes the input; returns false, with nothing changed, if invalid. A new finger starts at its position at
   once; in two dimensions the finger stays in the plane. */
bool finger_take(FingerState *state, const Finger *wanted, int dimensions);

/* True if the numbers of a saved state are a valid finger. */
bool finger_sound(const FingerState *state);

static inline bool finger_on(const FingerState *state)
{
    return state->wanted.way != (double)FINGER_NONE;
}

/* Number of the fluid that a finger pours; -1: does not pour. */
static inline int finger_fluid(const Finger *finger)
{
    return (int)finger->way - FINGER_POUR >= 0 ? (int)finger->way - FINGER_POUR : -1;
}

/* Greatest acceleration of a particle by pull and push, m/s2, as a bound for the step. */
double finger_acceleration(const FingerState *state);

/* Moves the point over `dt` (s). */
void finger_step(FingerState *state, const FingerLimits *limits, double dt, FingerStep *step);

/* 1 - exp(-x), relative error 1e-6, practically 1 from 16 on. Only the four basic operations, without a
   library: the same bits everywhere. Padé (2, 2) of x / 32, doubled five times. Same as
   shaders/sim/finger.glsl. */
static inline float finger_share(float x)
{
    const float y = (x < 16 ? x : 16) * (1 / 32.0F);
    float share = 12 * y / (12 + 6 * y + y * y);
    for (int k = 0; k < 5; k++)
        share *= 2 - share;
    return share;
}

/* Changes the velocity v of a particle at distance vector `d` from the point. */
static inline void finger_apply(const FingerStep *step, const float d[3], float v[3])
{
    const float q2 = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * step->inverse_radius2;
    if (!(q2 < 1))
        return;
    const float w = (1 - q2) * (1 - q2), share = finger_share(step->grip * w), kick = step->kick * w;
    for (int k = 0; k < 3; k++)
        v[k] += share * (step->velocity[k] - v[k]) + kick * d[k];
}

#endif
