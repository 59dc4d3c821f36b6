// What is found of particles at places of a picture: render/probe/particle_probe.h.
#include "shaders/shared/probe_bindings.h"

// Of some particles at one place.
struct Part {
    float ratio;   // least distance from a ball's centre in radii of that ball
    uint who;      // the number of that ball's particle
    float carried; // sum of V W s
    float field;   // sum of V W
    float lost;    // sum of V W where s is no number, which the other two leave out
};
layout(std430, binding = PROBE_PARTS_STORAGE) buffer Parts { Part parts[]; }; // those of a place lie side by side

struct Answer {
    vec4 place; // x y z in the box's frame, m; w 0: there is none
    vec4 own;   // x y z of the particle `who`; its scalar
    float ratio;
    uint who;
    float carried, field, lost;
    uint fluid, id; // of `who`
    uint unused;
};
layout(std430, binding = PROBE_ANSWERS_STORAGE) buffer Answers { Answer answers[]; };

const uint probe_nobody = 0xffffffffu;
const Part probe_nothing = Part(1e30, probe_nobody, 0.0, 0.0, 0.0);

// Of equals the first one counts.
Part together(Part a, Part b)
{
    bool nearer = b.ratio < a.ratio || (b.ratio == a.ratio && b.who < a.who);
    return Part(nearer ? b.ratio : a.ratio, nearer ? b.who : a.who, a.carried + b.carried, a.field + b.field, a.lost + b.lost);
}
