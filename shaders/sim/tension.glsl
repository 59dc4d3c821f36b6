// Surface tension within each fluid: sim/cpu/pairs_tension.c. `sum` is what its neighbours add.
#ifdef COHESION
// -g V_i V_j C(r) x_ij / r, Akinci 2013, eq. 1 and 2 with volumes for masses.
void tension_add(vec3 d, float r2, float volume, inout vec4 sum)
{
    float h = kernel.x, least = 1e-6 * h;
    if (r2 < least * least)
        return;
    float r = sqrt(r2), both = (h - r) * r, cube = both * both * both;
    sum.xyz -= volume * (r + r > h ? cube : cube + cube - h * h * h * h * h * h / 64.0) / r * d;
}

vec3 tension_force(vec4 sum, float volume, float tension) { return tension * volume * sum.xyz; }
#else
// -sigma (Laplacian of c) n / |n| a unit volume, n = grad c, where |n| > 0.3 / h: Müller 2003, eq. 15 to 19.
// sum: n, Laplacian.
void tension_add(vec3 d, float r2, float volume, inout vec4 sum)
{
    float h2 = kernel.x * kernel.x, dims = rows.x == 3 ? 2.0 : 3.0, weighed = volume * (h2 - r2);
    sum.xyz -= weighed * (h2 - r2) * d;
    sum.w -= weighed * (dims * h2 - (dims + 4.0) * r2);
}

vec3 tension_force(vec4 sum, float volume, float tension)
{
    tension_add(vec3(0), 0.0, volume, sum); // itself
    vec3 n = term_scales.z * sum.xyz;
    float size = length(n);
    return size * kernel.x < 0.3 ? vec3(0) : -tension * term_scales.z * sum.w * volume / size * n;
}
#endif
