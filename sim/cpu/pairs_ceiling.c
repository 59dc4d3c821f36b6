/* A loop that does nothing but multiply and add, in registers of the set's width: the most that a pair loop
   could do. */
#include "sim/cpu/pair_loop.h"

#if defined(__AVX512F__)
enum { WIDTH = 64 };
#elif defined(__AVX__)
enum { WIDTH = 32 };
#else
enum { WIDTH = 16 };
#endif
typedef float Wide __attribute__((vector_size(WIDTH)));

enum { CHAINS = 12 }; /* independent ones: more than two units times the latency of a sum would need */

/* (end - begin) times; fx: operations each time, bits of a register, and a sum that nobody needs. */
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
