#include "app/base/physical.h"

#include <math.h>
#include <stdbool.h>
#include <unistd.h>

static bool left;

double physical_bytes(void)
{
    return left ? (double)INFINITY : (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

void physical_leave(void)
{
    left = true;
}
