// The kernel's shape at q = r / h below 1, as in render/particles/plane.c; KERNEL is the index there.
float plane_shape(float q)
{
    float t = 1.0 - q;
#if KERNEL == 1
    return q < 0.5 ? 1.0 - 6.0 * q * q * t : 2.0 * t * t * t;
#elif KERNEL == 2
    return t * t * t * t * (1.0 + 4.0 * q);
#elif KERNEL == 3
    float a = 3.0 * t, b = max(2.0 - 3.0 * q, 0.0), c = max(1.0 - 3.0 * q, 0.0);
    return a * a * a * a * a - 6.0 * b * b * b * b * b + 15.0 * c * c * c * c * c;
#elif KERNEL == 4
    float u = 1.0 - q * q;
    return u * u * u;
#elif KERNEL == 5
    return t * t * t;
#else
    return t * t;
#endif
}
