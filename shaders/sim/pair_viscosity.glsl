// Viscosity of a pair: pair_viscosity of sim/def/fluids.h; a sum for a single fluid.
float pair_viscosity(float a, float b)
{
#ifdef ONE_FLUID
    return a + b;
#else
    return a + b > 0.0 ? 4.0 * a * b / (a + b) : 0.0;
#endif
}
