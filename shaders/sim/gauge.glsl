// Contribution of a particle to the gauge: mirrors sim/step/backend.h.

#ifdef ENERGY_OF_METHOD
#include ENERGY_OF_METHOD
#else
float compression_energy(float x) { return 0.0; }
#endif

// Compression above rest density, and energies of motion, gravity and compression; c2: c^2.
vec4 gauge_of(float mass, float compression, vec3 x, vec3 v, vec3 gravity, float c2)
{
#ifdef NEGATIVE_PRESSURE
    float stored = compression;
#else
    float stored = max(compression, 0.0);
#endif
    return vec4(max(compression, 0.0),
                mass * vec3(0.5 * dot(v, v), -dot(gravity, x), c2 * compression_energy(stored)));
}
