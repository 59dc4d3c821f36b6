// Particle data at positions in a picture: render/picking/picking.h.
#include "shaders/shared/probe_bindings.h"

// Result of some particles at one position.
struct Part {
    float ratio;   // least distance from a ball's centre, in radii of the ball
    uint who;      // index of the particle of this ball
    float carried; // sum of V W s
    float field;   // sum of V W
    float lost;    // sum of V W for NaN s, excluded from `carried` and `field`
};
layout(std430, binding = PROBE_PARTS_STORAGE) buffer Parts { Part parts[]; }; // the parts of a position are contiguous

struct Answer {
    vec4 place; // x y z in the box's frame, m; w 0: no position
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

// Of equal ratios, the lower index wins.
Part together(Part a, Part b)
{
    bool nearer = b.ratio < a.ratio || (b.ratio == a.ratio && b.who < a.who);
    return Part(nearer ? b.ratio : a.ratio, nearer ? b.who : a.who, a.carried + b.carried, a.field + b.field, a.lost + b.lost);
}
