// A cup of water from a scene in the program itself, shaken to and fro; how high the water comes.
#include <slosh/world.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

static const std::string text = R"(
title: Cup
box: {size: [0.2, 0.3, 0.1]}
particles: {spacing: 0.01}
fluids: [{name: water, density: 1000, viscosity: 0.5, fill: [{block: {min: [-0.1, 0, -0.05], max: [0.1, 0.1, 0.05]}}]}]
)";

int main()
{
    slosh_error error;
    const std::unique_ptr<slosh_scene, decltype(&slosh_scene_free)> scene(
        slosh_scene_parse("cup.yaml", text.data(), text.size(), nullptr, 0, &error), slosh_scene_free);
    const std::unique_ptr<slosh_world, decltype(&slosh_world_destroy)> world(
        scene ? slosh_world_create(scene.get(), &error) : nullptr, slosh_world_destroy);
    bool ok = world != nullptr;
    float top = 0;
    while (ok && slosh_world_time(world.get()) < 0.5) {
        const double at[3] = {0.05 * std::sin(12 * slosh_world_time(world.get())), 0, 0};
        slosh_column position = {};
        position.size = sizeof position;
        ok = slosh_world_move_box(world.get(), at, nullptr, &error) &&
             slosh_world_step(world.get(), &error) &&
             slosh_world_column(world.get(), "position", &position, &error);
        for (size_t i = 0; ok && i < position.count; i++) {
            const auto *row = static_cast<const char *>(position.data) + i * position.stride;
            top = std::fmax(top, reinterpret_cast<const float *>(row)[1]);
        }
    }
    if (ok)
        std::printf("the water came up to %.3f m\n", top);
    else
        std::fprintf(stderr, "%s\n", error.message);
    return ok ? 0 : 1;
}
