// Corrections of the gradients, two vec4 per particle, xx yy zz and xy yz zx: sim/methods/wcsph/wcsph_passes.c.
layout(std430, binding = CORRECTIONS_BUFFER) CORRECTION_ACCESS buffer Corrections { vec4 correction[]; };

// C x, with C of particle i.
vec3 corrected(uint i, vec3 x)
{
    vec3 m = correction[2u * i + 1u].xyz;
    return correction[2u * i].xyz * x + vec3(m.x * x.y + m.z * x.z, m.x * x.x + m.y * x.z, m.z * x.x + m.y * x.y);
}
