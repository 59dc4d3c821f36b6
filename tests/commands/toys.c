/* The program with a method and a view that it does not have: each adds itself, and no other file knows it.
 */
#include "tests/render/toy_view.h"
#include "tests/sim/toy_method.h"

static __attribute__((constructor)) void add(void)
{
    toy_method_add();
    toy_view_add();
}
