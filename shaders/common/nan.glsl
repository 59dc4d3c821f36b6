// NaN test by bits: GLSL does not promise correct comparisons of NaN, and a compiler may turn "not x > 0" into x <= 0.
bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }

const vec3 no_number_color = vec3(1.0, 0.0, 0.6); // linear light: magenta, which no colormap contains

// True if any component is NaN.
bool is_nan(vec4 x) { return any(greaterThan(floatBitsToUint(x) & 0x7fffffffu, uvec4(0x7f800000u))); }
