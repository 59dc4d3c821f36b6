#include "sim/gl/backends.h"
#include "sim/world/backend.h"

void backends_add(void)
{
    backend_add(&backend_compute);
    backend_add(&backend_fragment);
}
