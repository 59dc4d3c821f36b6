/* A loop of multiplications and additions in registers of the set's width: an upper bound for pair loops. */
#include "sim/cpu/pair_loop.h"

#if defined(__AVX512F__)
enum { WIDTH = 64 };
#elif defined(__AVX__)
enum { WIDTH = 32 };
#else
enum { WIDTH = 16 };
#endif
typedef float Wide __attribute__((vector_size(WIDTH)));

enum { CHAINS = 12 }; /* independent chains: more than two units need to hide the latency of a sum */

/* Runs (end - begin) rounds. fx[0]: operations per round; fx[1]: register bits; fx[2]: an unused sum. */
PAIR_LOOP(multiply_add)
{
    Wide a[CHAINS], factor = {0}, term = {0};
    factor += 0.999F;
    term += 0.001F;
    for (int k = 0; k < CHAINS; k++)
        a[k] = term * (float)k;
    for (size_t round = begin; round < end; round++)
        for (int k = 0; k < CHAINS; k++)
            a[k] = a[k] * factor + term;
    for (int k = 1; k < CHAINS; k++)
        a[0] += a[k];
    args->fx[0] = 2.0F * CHAINS * WIDTH / sizeof(float);
    args->fx[1] = 8.0F * WIDTH;
    args->fx[2] = a[0][0];
}
