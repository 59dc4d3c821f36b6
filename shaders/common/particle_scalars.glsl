// Addition to common/particles.glsl: the scalar shown.
#include "shaders/shared/bindings.h"
layout(std430, binding = SCALARS_STORAGE) readonly buffer Scalars { float scalar_words[]; };
