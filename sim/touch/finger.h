/* What a user does to the fluid with a finger: in a ball about a point it stirs, pulls or pushes, or fluid
   comes from a disk there (sim/world/world_flow.c). The point follows what the user asks for in simulated
   time; where nobody touches there is no pass and no branch.

   With q = |x - point| / radius and w = (1 - q^2)^2 inside, 0 outside, over a step of dt
     stir: v += (1 - exp(-strength w dt)) (V - v), exact for a particle that keeps its place: it never
   overshoots; pull, push: v -+= strength dt w q / max(w q) along x - point, so that the middle feels nothing.
 */
#ifndef SLOSH_FINGER_H
#define SLOSH_FINGER_H

#include <stdbool.h>

typedef enum FingerWay {
    FINGER_NONE,
    FINGER_STIR,
    FINGER_PULL,
    FINGER_PUSH,
    FINGER_POUR, /* of the first fluid; behind it that of the others */
    FINGER_WAYS
} FingerWay;

enum { FINGER_FLUIDS = 8 };

/* What is asked for. Doubles only, as all of the saved state. */
typedef struct Finger {
    double way;      /* a FingerWay; FINGER_POUR and the number of the fluid */
    double at[3];    /* box's frame, m */
    double radius;   /* of the ball, or the disk, m */
    double strength; /* stir: 1/s; pull, push: the most that a particle feels, m/s2; pour: speed, m/s */
} Finger;

/* Zero: nobody touches. */
typedef struct FingerState {
    Finger wanted;
    double point[3]; /* where it is, box's frame, m */
} FingerState;

/* Of one step. Zero: nobody touches the fluid that is there. */
typedef struct FingerStep {
    bool on;
    float at[3], velocity[3];      /* in the middle of the step, m; of the point, m/s */
    float radius, inverse_radius2; /* m, 1/m2 */
    float grip;                    /* stir: strength dt */
    float kick; /* pull, push: what a particle gains per metre off the point where w is 1, 1/s */
} FingerStep;

/* What a step may do to a particle at most. */
typedef struct FingerLimits {
    double speed; /* of the point, m/s: the sentinel takes a faster particle for a lost one */
    double gain;  /* by pull and push in one step, m/s */
} FingerLimits;

/* Takes what is asked for; false, and all stays, where it is no finger. One that begins is there at once. In
   two dimensions it stays in the plane. */
bool finger_take(FingerState *state, const Finger *wanted, int dimensions);

/* Whether numbers of a saved state are one. */
bool finger_sound(const FingerState *state);

static inline bool finger_on(const FingerState *state)
{
    return state->wanted.way != (double)FINGER_NONE;
}

/* The number of the fluid that a finger pours; -1: it does not pour. */
static inline int finger_fluid(const Finger *finger)
{
    return (int)finger->way - FINGER_POUR >= 0 ? (int)finger->way - FINGER_POUR : -1;
}

/* The most that pull and push accelerate a particle, m/s2: bounds a step that is chosen by it. */
double finger_acceleration(const FingerState *state);

/* Carries the point over `dt` (s). */
void finger_step(FingerState *state, const FingerLimits *limits, double dt, FingerStep *step);

/* 1 - exp(-x) to 1e-6 of it, from 16 on 1 as good as, by the four operations alone: no library, the same bits
   everywhere. Pade's (2, 2) of x / 32, five times doubled. shaders/sim/finger.glsl has the same. */
static inline float finger_share(float x)
{
    const float y = (x < 16 ? x : 16) * (1 / 32.0F);
    float share = 12 * y / (12 + 6 * y + y * y);
    for (int k = 0; k < 5; k++)
        share *= 2 - share;
    return share;
}

/* What a particle gains that is `d` off the point and moves by v. */
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
