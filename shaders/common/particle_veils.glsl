// Addition to common/particles.glsl: opacity and start of the screen-door of translucent particles: common/veil.glsl.
#include "shaders/shared/bindings.h"
layout(std430, binding = VEILS_STORAGE) readonly buffer Veils { vec2 veil[]; };
