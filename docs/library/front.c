/* A dam breaks: how far its front has come, every 0.1 s. */
#include "sim/world.h"

#include <stdio.h>
#include <stdlib.h>

int main(void)
{
    Error error = {{0}};
    WorldDef def = world_def_default(); /* what is not set below; the method is mueller, the backend cpu */
    def.dimensions = 2;
    def.box_size[0] = 1.6, def.box_size[1] = 0.6;
    def.spacing = 0.02, def.support = 2.6;
    def.fluid_count = 1;
    const Fill column = {.kind = FILL_BLOCK, .min = {-0.8, 0}, .max = {-0.4, 0.4}};
    def.fluids[0] =
        (FluidDef){.name = "water", .density = 1000, .viscosity = 0.1, .fill_count = 1, .fills = &column};

    World *world = world_create(&def, &error);
    WorldInfo info = {0};
    float *position = NULL;
    while (world && info.time < 0.45) {
        for (int frame = 0; frame < 10 && world_step(world, NULL, &error); frame++)
            ;
        world_info(world, &info);
        position = realloc(position, 4 * info.count * sizeof *position);
        double front = -0.8;
        if (error.message[0] || !position || !world_read(world, &(ParticleArrays){.position = position}))
            break;
        for (size_t i = 0; i < info.count; i++)
            front = position[4 * i] > front ? position[4 * i] : front;
        printf("%.2f s: %.3f m\n", info.time, front + 0.8);
    }
    fputs(error.message, stderr);
    free(position);
    world_destroy(world);
    return error.message[0] != 0;
}
