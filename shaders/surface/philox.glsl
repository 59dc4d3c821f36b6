// Counter-based random numbers, equal to those of sim/points/philox.h. After: J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel
// random numbers: as easy as 1, 2, 3", 2011.
uvec4 philox(uvec2 key, uvec4 word)
{
    for (int round = 0; round < 10; round++) {
        uint high_a, low_a, high_b, low_b;
        umulExtended(0xD2511F53u, word.x, high_a, low_a);
        umulExtended(0xCD9E8D57u, word.z, high_b, low_b);
        word = uvec4(high_b ^ word.y ^ key.x, low_b, high_a ^ word.w ^ key.y, low_a);
        key += uvec2(0x9E3779B9u, 0xBB67AE85u);
    }
    return word;
}

// In 0 .. 1, both ends excluded.
float uniform_part(uint word)
{
    return (float(word >> 9) + 0.5) / 8388608.0;
}

// f8_log of sim/base/simd.h.
float exact_log(float a)
{
    int exponent = int(floatBitsToUint(a) >> 23 & 0xffu) - 126;
    float m = uintBitsToFloat(floatBitsToUint(a) & 0x007fffffu | 0x3f000000u); // 1/2 .. 1
    if (m < 0.70710678) {
        exponent--;
        m += m;
    }
    m -= 1.0;
    float p = 7.0376836292e-2;
    p = p * m - 1.1514610310e-1;
    p = p * m + 1.1676998740e-1;
    p = p * m - 1.2420140846e-1;
    p = p * m + 1.4249322787e-1;
    p = p * m - 1.6668057665e-1;
    p = p * m + 2.0000714765e-1;
    p = p * m - 2.4999993993e-1;
    p = p * m + 3.3333331174e-1;
    float square = m * m;
    return m + (p * m * square - 0.5 * square) + float(exponent) * 0.69314718;
}

// Normally distributed numbers with mean 0 and variance 1. After: G. Box, M. Muller, "A note on the generation of random normal
// deviates", 1958.
vec3 philox_normal(uvec4 word)
{
    float r = sqrt(-2.0 * exact_log(uniform_part(word.x))), other = sqrt(-2.0 * exact_log(uniform_part(word.z)));
    return vec3(r * turn(uniform_part(word.y)).yx, other * turn(uniform_part(word.w)).y);
}
