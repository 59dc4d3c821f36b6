// The trail of a particle, if any: fixed by the id alone, the same at each step.
#include "shaders/trails/trails_bindings.h"

layout(location = TRAIL_EVERY_AT) uniform uint every;
layout(location = TRAIL_SLOTS_AT) uniform uint slots;
layout(location = TRAIL_LISTED_AT) uniform uint listed; // 0: by stride
layout(location = TRAIL_LIST_AT) uniform uint list[TRAIL_LISTED_IDS];

int slot_of(uint id)
{
    for (uint i = 0u; i < listed; i++)
        if (list[i] == id)
            return int(i);
    return listed > 0u || id % every != 0u ? -1 : int(id / every % slots);
}
