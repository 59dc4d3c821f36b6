// Of common/particles.glsl: the scalar that is shown.
layout(std430, binding = 1) readonly buffer Scalars { float scalar_words[]; };
