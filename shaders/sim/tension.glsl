// Surface tension within each fluid: sim/cpu/pairs_shared.c. No force without a model.
#ifdef TENSION
uint tension_fluid;
vec4 tension_sum = vec4(0); // sum over the neighbours

#ifdef COHESION
// -g V_i V_j C(r) x_ij / r, Akinci 2013, eq. 1 and 2 with volumes instead of masses; r and h in units of u.
void tension_add(vec3 d, float r2, float volume)
{
    float least = 1e-6 * support;
    if (r2 < least * least)
        return;
    float h = inverse_unit * support, r = inverse_unit * sqrt(r2), both = (h - r) * r, cube = both * both * both;
    tension_sum.xyz -= volume * (r + r > h ? cube : cube + cube - h * h * h * h * h * h / 64.0) / r * d;
}

vec3 tension_of_sum(float volume, float tension) { return tension * volume * tension_sum.xyz; }
#else
// -sigma (Laplacian of c) n / |n| per unit volume, n = grad c, if |n| > 0.3 / h: Mueller 2003, eq. 15 to 19.
// tension_sum: n, Laplacian; squared lengths in units of u^2.
void tension_add(vec3 d, float r2, float volume)
{
    float inverse2 = inverse_unit * inverse_unit, h2 = inverse2 * (support * support), s2 = inverse2 * r2;
    float dims = dimensions == 2 ? 2.0 : 3.0, weighed = volume * (h2 - s2);
    tension_sum.xyz -= weighed * (h2 - s2) * d;
    tension_sum.w -= weighed * (dims * h2 - (dims + 4.0) * s2);
}

vec3 tension_of_sum(float volume, float tension)
{
    tension_add(vec3(0), 0.0, volume); // the particle itself
    vec3 n = colour_scale * tension_sum.xyz;
    float size = length(n);
    return size * support < 0.3 ? vec3(0) : -tension * colour_scale * tension_sum.w * volume / size * n;
}
#endif

void tension_begin(uint i) { tension_fluid = FLUID_OF(i); }

void tension_meet(uint j, vec3 d, float r2)
{
    if (FLUID_OF(j) == tension_fluid)
        tension_add(d, r2, volume_of(j));
}

vec3 tension_force(uint i) { return tension_of_sum(volume_of(i), fluid_terms[tension_fluid].tension); }
#else
#define tension_begin(i)
#define tension_meet(j, d, r2)
#define tension_force(i) vec3(0)
#endif
