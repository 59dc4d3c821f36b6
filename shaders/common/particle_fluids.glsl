// Of common/particles.glsl: which fluid a particle is of.
#include "shaders/shared/bindings.h"
layout(std430, binding = FLUIDS_STORAGE) readonly buffer Fluids { uint fluid_words[]; };
