#include "sim/step/backend.h"
#include "sim/step/method.h"
#include "sim/step/world.h"

#include <string.h>

/* True if `word` is in the blank-separated list. */
static bool has_word(const char *list, const char *word)
{
    const size_t size = strlen(word);
    for (const char *at = list; at && (at = strstr(at, word)); at += size)
        if ((at == list || at[-1] == ' ') && (at[size] == ' ' || at[size] == 0))
            return true;
    return false;
}

/* Bytes per particle of the needed columns: each read once, written once. */
static double column_bytes(const World *world, const Pass *pass)
{
    const ColumnRows rows = column_rows(world->method->columns, 0, &world->constants);
    double sum = 0;
    for (int k = 0; k < rows.count; k++) {
        const ColumnDef *row = rows.row[k];
        const int times = has_word(pass->reads, row->name) + has_word(pass->writes, row->name);
        sum += times * row->components * (double)column_size(row);
    }
    return sum;
}

static MicroPart part_of(const World *world, const Pass *pass)
{
    const BackendMicro *micro = world->backend->micro;
    MicroPart part = {.name = pass->name, .pass = pass, .stream = column_bytes(world, pass)};
    part.pairs = micro->pair(pass, &world->constants, &part.pair);
    part.stream_a_pair = part.pairs ? micro->stream_a_pair : 0;
    return part;
}

int world_micro_parts(const World *world, MicroPart parts[MICRO_PARTS_MAX])
{
    const BackendMicro *micro = world->backend->micro;
    int count = 0;
    if (!micro)
        return 0;
    parts[count++] = (MicroPart){.name = "grid", .stream = micro->grid_stream(world->state)};
    parts[count++] = part_of(world, micro->neighbours);
    for (const Pass *const *pass = world->method->passes; *pass && count < MICRO_PARTS_MAX; pass++)
        if (!(*pass)->needed || (*pass)->needed(&world->constants))
            parts[count++] = part_of(world, *pass);
    return count;
}

void world_micro_run(World *world, const MicroPart *part)
{
    ApparentGravity apparent;
    const BoxState *box = &world->box;
    if (!part->pass) {
        world->backend->grid(world->state);
        return;
    }
    apparent_gravity(world->def.gravity, box, box, box, world->stepping.dt, &apparent);
    world->backend->run(world->state, part->pass, &(PassInput){.dt = 0, .apparent = &apparent});
}

bool world_micro_sound(World *world)
{
    return !world->backend->watch(world->state).memory;
}

bool world_micro_ceilings(const World *world, Ceilings *out)
{
    return world->backend->micro && world->backend->micro->ceilings(world->state, out);
}
