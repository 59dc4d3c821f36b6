// The kernels of solver.kernel, selected by a define; default: the cubic spline. sim/cpu/pair_loop.h.

// f(q) = -w'(q) / q of the kernel, up to a factor in gradient_scale.
float shape(float q)
{
    float t = 1.0 - q;
#if defined KERNEL_WENDLAND_C2
    return 20.0 * (t * t * t);
#elif defined KERNEL_QUINTIC
    vec3 powers = max(vec3(3.0 * t, 3.0 * t - 1.0, 3.0 * t - 2.0), 0.0);
    powers *= powers;
    powers *= powers;
    return (powers.x - 6.0 * powers.y + 15.0 * powers.z) / q;
#else
    return q < 0.5 ? 12.0 - 18.0 * q : 6.0 * (t * t) / q;
#endif
}

// w(q) / w(0).
float height(float q)
{
    float t = 1.0 - q;
#if defined KERNEL_WENDLAND_C2
    return t * t * t * t * (1.0 + 4.0 * q);
#elif defined KERNEL_QUINTIC
    vec3 base = max(vec3(3.0 * t, 3.0 * t - 1.0, 3.0 * t - 2.0), 0.0), powers = base * base;
    powers *= powers * base;
    return (powers.x - 6.0 * powers.y + 15.0 * powers.z) / 66.0;
#else
    return q < 0.5 ? 1.0 - 6.0 * q * q * t : 2.0 * t * t * t;
#endif
}
