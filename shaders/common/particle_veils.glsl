// Of common/particles.glsl: of particles that are not opaque the opacity, and where the screen-door begins: common/veil.glsl.
#include "shaders/shared/bindings.h"
layout(std430, binding = VEILS_STORAGE) readonly buffer Veils { vec2 veil[]; };
