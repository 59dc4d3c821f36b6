/* Threads that compute take denormal numbers for 0, and leave the caller's arithmetic as it was. */
#include "sim/base/base.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RANGES = 64 };

typedef struct Products {
    volatile float small, denormal; /* the compiler does not know them */
    float result[RANGES], operand[RANGES];
} Products;

static void multiply(void *context, size_t begin, size_t end)
{
    Products *p = context;
    for (size_t r = begin; r < end; r++) {
        p->result[r] = p->small * p->small;
        p->operand[r] = 0x1p100F * p->denormal;
    }
}

static void denormals_are_zero(void **state)
{
    (void)state;
#if !defined(__SSE2__) && !defined(__aarch64__)
    skip();
#endif
    for (int threads = 1; threads <= 4; threads += 3) {
        Products p = {.small = 0x1p-70F, .denormal = 0x1p-140F};
        parallel_ranges(threads, RANGES, 1, multiply, &p);
        for (size_t r = 0; r < RANGES; r++)
            assert_true(p.result[r] == 0 && p.operand[r] == 0);
        multiply(&p, 0, 1);
        assert_true(p.result[0] > 0 && p.operand[0] > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(denormals_are_zero)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
