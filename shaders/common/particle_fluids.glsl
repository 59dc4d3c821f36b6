// Of common/particles.glsl: which fluid a particle is of.
layout(std430, binding = 2) readonly buffer Fluids { uint fluid_words[]; };
