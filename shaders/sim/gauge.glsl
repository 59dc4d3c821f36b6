// What a particle adds to the gauge: mirrors sim/world/gauge.h.

// Energy of compression over m c^2, of x = rho / rho0 - 1.
float gauge_compression_energy(float x)
{
#ifdef CARRIES_DENSITY
    return x * x * (2.5 + x * (10.0 / 3.0 + x * (2.5 + x * (1.0 + x / 6.0))) + 1.0 / (1.0 + x)) / 7.0;
#else
    if (abs(x) > 0.1)
        return log(1.0 + x) - x / (1.0 + x);
    float sum = 0.0; // where these two all but cancel, their series
    for (int n = 8; n >= 2; n--)
        sum = float(n - 1) / float(n) - x * sum;
    return x * x * sum;
#endif
}

// The sum of pressed density, the energies of motion, gravity and compression; c2: c^2.
vec4 gauge_of(float mass, float compression, vec3 x, vec3 v, vec3 gravity, float c2)
{
#ifdef NEGATIVE_PRESSURE
    float stored = compression;
#else
    float stored = max(compression, 0.0);
#endif
    return vec4(max(compression, 0.0),
                mass * vec3(0.5 * dot(v, v), -dot(gravity, x), c2 * gauge_compression_energy(stored)));
}
