/* Fuzz target of the scene loader. What stands before a first byte 0 is a --set; a '#' at the end asks for
   --particles 1000. */
#include "app/scene/scene.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(bool ok, const Scene *scene, const Error *error)
{
    const WorldDef *world = &scene->world;
    if (!ok && !*error->message)
        abort(); /* refused without a word */
    if (ok && !(world->fluid_count > 0 && world->spacing > 0 && world->dt > 0 && world->substeps > 0))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static Scene scene;
    Error error = {""};
    char setting[256];
    Notes notes;
    SceneSettings settings = {.particles = size > 0 && data[size - 1] == '#' ? 1000 : 0};
    const uint8_t *zero = size > 0 ? memchr(data, 0, size) : NULL;
    const size_t length = zero ? (size_t)(zero - data) : 0;
    if (zero && length < sizeof setting) {
        memcpy(setting, data, length + 1);
        settings.set[settings.count++] = setting;
        data += length + 1;
        size -= length + 1;
    }
    check(scene_parse("fuzz.yaml", (const char *)data, size, &settings, &scene, &notes, &error), &scene,
          &error);
    return 0;
}
