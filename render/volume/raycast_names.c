#include "render/volume/raycast_names.h"

const char *const raycast_look_names[] = {
    [RAYCAST_OPAQUE] = "opaque", [RAYCAST_WATER] = "water", [RAYCAST_TRANSLUCENT] = "translucent"};

RaycastDef raycast_def_default(void)
{
    return (RaycastDef){.level = 0.5, /* the field of a fluid that ends at a plane, at that plane */
                        .step = 1,
                        .threshold = 0.99, /* what is left is 2 of 255 */
                        .ramp = {0.35, 0.65},
                        .opacity = 0.04,
                        .skin = 0.4,
                        .ior = 1.333,
                        .shadows = true,
                        .jitter = true,
                        .skip = true};
}

bool raycast_same_kind(const Subject *a, const Subject *b)
{
    const RaycastDef *x = &a->def->raycast, *y = &b->def->raycast;
    return x->look == y->look && x->shadows == y->shadows &&
           (a->def->color_by == SCALAR_FLUID) == (b->def->color_by == SCALAR_FLUID) &&
           (a->world->fluid_count > 1) == (b->world->fluid_count > 1);
}
