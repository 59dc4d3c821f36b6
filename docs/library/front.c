/* A dam breaks: how far its front has come, every 0.1 s. */
#include <slosh/world.h>

#include <stdio.h>

static double front_of(slosh_world *world, slosh_error *error)
{
    slosh_column position = {.size = sizeof position};
    double front = 0;
    if (!slosh_world_column(world, "position", &position, error))
        return -1;
    for (size_t i = 0; i < position.count; i++) {
        const float *x = (const float *)((const char *)position.data + i * position.stride);
        front = x[0] + 0.8 > front ? x[0] + 0.8 : front; /* the box is 1.6 m wide, and x = 0 in the middle */
    }
    return front;
}

int main(void)
{
    slosh_error error = {{0}};
    const char *settings[] = {"particles=2000", "fluids[0].viscosity=0.1"};
    slosh_scene *scene = slosh_scene_load("dam_break", settings, 2, &error);
    slosh_world *world = scene ? slosh_world_create(scene, &error) : NULL;
    bool ok = world;
    for (int k = 1; ok && k <= 5; k++) {
        ok = slosh_world_run(world, 0.1 * k, &error);
        printf("%.1f s: %.3f m\n", 0.1 * k, front_of(world, &error));
    }
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    slosh_world_destroy(world);
    slosh_scene_free(scene);
    return ok ? 0 : 1;
}
