// Addition to common/particles.glsl: the particles' fluids.
#include "shaders/shared/bindings.h"
layout(std430, binding = FLUIDS_STORAGE) readonly buffer Fluids { uint fluid_words[]; };
