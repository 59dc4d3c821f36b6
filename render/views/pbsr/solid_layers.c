#include "render/frame/passes.h"
#include "render/views/pbsr/pbsr_private.h"

#include <string.h>

_Static_assert(OUTSIDE_NUMBER == AVERAGE_NUMBERS_MAX - 1, "the last number that a word has room for");

int solid_layers_number(const PbsrDef *def)
{
    for (int i = 0; i < def->layer_count; i++)
        if (def->layers[i].of == PBSR_SOLIDS)
            return i;
    return -1;
}

/* ---- colours ---- */

static bool same_color(const SolidDef *a, const SolidDef *b)
{
    return a->color[0] == b->color[0] && a->color[1] == b->color[1] && a->color[2] == b->color[2];
}

/* Index of a solid's colour, in the order of first use. */
static int color_of(const WorldDef *world, int index)
{
    int colors = 0;
    for (int i = 0; i <= index; i++) {
        int same = 0;
        while (same < i && !same_color(&world->solids[same], &world->solids[i]))
            same++;
        if (i == index && same < i)
            return color_of(world, same);
        colors += same == i;
    }
    return colors - 1;
}

int solid_layers_colors(const WorldDef *world)
{
    int colors = 0;
    for (int i = 0; i < world->solid_count; i++)
        colors = color_of(world, i) + 1 > colors ? color_of(world, i) + 1 : colors;
    return colors;
}

static unsigned number_of(const PbsrDef *def, int layer, const WorldDef *world, int solid)
{
    const int color = color_of(world, solid);
    if (pbsr_has_color(&def->layers[layer]))
        return (unsigned)layer;
    return SOLID_NUMBERS + (unsigned)(color < SOLID_COLORS_MAX ? color : SOLID_COLORS_MAX - 1);
}

void solid_layers_fill_looks(const PbsrDef *def, const WorldDef *world,
                             AverageLook looks[AVERAGE_NUMBERS_MAX])
{
    const int layer = solid_layers_number(def);
    if (layer < 0 || pbsr_has_color(&def->layers[layer]))
        return;
    for (int i = world->solid_count - 1; i >= 0; i--) {
        AverageLook *look = &looks[number_of(def, layer, world, i)];
        *look = (AverageLook){.own = true, .lit = true, .turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        memcpy(look->color, world->solids[i].color, sizeof look->color);
    }
}

/* ---- meshes ---- */

static bool take_mesh(const SolidMesh *mesh, Polygons *polygons, Error *error)
{
    if (!polygons_reserve(polygons, mesh->vertex_count, mesh->index_count / 3, error))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        memcpy(polygons->place[i], mesh->vertices[i].position, sizeof polygons->place[i]);
        memcpy(polygons->normal[i], mesh->vertices[i].normal, sizeof polygons->normal[i]);
    }
    memcpy(polygons->corner, mesh->indices, polygons->triangle_count * sizeof *polygons->corner);
    return true;
}

static void begin(RigidLayer *rigid, const SolidDef *solid, const PbsrDef *def, double slab, int index,
                  int count)
{
    SolidMesh mesh = {0};
    Polygons polygons = {0};
    rigid_layer_free(rigid);
    if (!solid_mesh_add(&mesh, solid, slab, 0))
        error_set(&rigid->trouble, "no memory for the mesh of a solid");
    else if (take_mesh(&mesh, &polygons, &rigid->trouble))
        rigid_layer_of_polygons(rigid, &polygons, def, PBSR_LAYERS_MAX + (unsigned)index, 1.0 / count);
    solid_mesh_destroy(&mesh);
}

/* ---- poses ---- */

/* Rotation from the solid's frame to the box's frame. */
static void turn_of(const BoxState *pose, float turn[3][3])
{
    for (int k = 0; k < 3; k++) {
        double unit[3] = {0}, turned[3];
        unit[k] = 1;
        quat_rotate(pose->orientation, unit, turned);
        for (int i = 0; i < 3; i++)
            turn[i][k] = (float)turned[i];
    }
}

static void see_from(RigidLayer *rigid, const BoxState *pose, const SetSight *sight)
{
    turn_of(pose, rigid->turn);
    rigid->sight = *sight;
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++) {
            rigid->sight.row[r][k] = 0;
            for (int i = 0; i < 3; i++)
                rigid->sight.row[r][k] += sight->row[r][i] * rigid->turn[i][k];
            rigid->sight.row[r][3] += sight->row[r][k] * (float)pose->position[k];
        }
}

/* ---- all solids ---- */

static bool same(const SolidLayers *layers, int index, const SolidDef *solid, const PbsrDef *def, double slab,
                 unsigned number, int count)
{
    const RigidLayer *rigid = &layers->rigid[index];
    return rigid->followed && rigid->seed == def->seed && rigid->repeat == def->repeat &&
           rigid->most == def->points * (1.0 / count) && layers->slab == slab &&
           layers->numbers[index] == number && solid_mesh_same(&layers->shapes[index], solid);
}

void solid_layers_update(SolidLayers *layers, const PbsrDef *def, double time, const Frame *frame,
                         const SetSight *sight)
{
    const WorldDef *world = frame->world;
    layers->layer = solid_layers_number(def);
    const int count = layers->layer < 0 ? 0 : world->solid_count;
    for (int i = count; i < layers->count; i++)
        rigid_layer_free(&layers->rigid[i]);
    for (int i = 0; i < count; i++) {
        const SolidDef *solid = &world->solids[i];
        const unsigned number = number_of(def, layers->layer, world, i);
        RigidLayer *rigid = &layers->rigid[i];
        BoxState pose;
        rigid->moving = layers->moving;
        if (!same(layers, i, solid, def, frame->slab, number, count))
            begin(rigid, solid, def, frame->slab, i, count);
        rigid->followed = true;
        layers->shapes[i] = *solid;
        layers->numbers[i] = number;
        solid_pose_in(solid, time, &frame->floating[i], &pose);
        see_from(rigid, &pose, sight);
        if (rigid->begun)
            (void)rigid_layer_make_points(rigid, &def->layers[layers->layer], true, number);
    }
    layers->count = count;
    layers->slab = frame->slab;
}

void solid_layers_free(SolidLayers *layers)
{
    for (int i = 0; i < SOLIDS_MAX; i++)
        rigid_layer_free(&layers->rigid[i]);
    layers->count = 0;
}
