/* Reads the meshes of a scene, and reports their faults. */
#include "app/base/notes.h"
#include "app/mesh_file/mesh_count.h"
#include "app/mesh_file/mesh_file.h"
#include "app/scene/advise.h"
#include "app/scene/check_parts.h"
#include "app/scene/tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool scene_names_mesh(const char *text)
{
    return mesh_format(text) != MESH_UNKNOWN;
}

typedef struct Reader {
    Check check;
    const SceneSettings *settings;
    Notes *notes;
} Reader;

/* The name in lines: of a long path the end. */
static const char *name_of(const MeshUse *mesh)
{
    enum { SHOWN = 90 };
    const size_t length = strlen(mesh->file);
    return mesh->file + (length > SHOWN ? length - SHOWN : 0);
}

/* ---- unit of the file ---- */

static double length_of(const MeshUse *mesh)
{
    const double *half = mesh->shape->half;
    return 2 * mesh->scale * fmax(fmax(half[0], half[1]), half[2]);
}

static double diagonal_of(const WorldDef *world)
{
    const double *size = world->box_size;
    return sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
}

static bool is_odd(const WorldDef *world, const MeshUse *mesh)
{
    return mesh->shape && (length_of(mesh) > diagonal_of(world) || length_of(mesh) < world->spacing);
}

static const MeshUse *first_odd(const WorldDef *world)
{
    for (int f = 0; f < world->fluid_count; f++)
        for (int i = 0; i < world->fluids[f].fill_count; i++)
            if (world->fluids[f].fills[i].kind == FILL_MESH && is_odd(world, &world->fluids[f].fills[i].mesh))
                return &world->fluids[f].fills[i].mesh;
    for (int k = 0; k < world->solid_count; k++)
        if (world->solids[k].kind == SOLID_MESH && is_odd(world, &world->solids[k].mesh))
            return &world->solids[k].mesh;
    return NULL;
}

bool scene_ask_scale(const Check *check, const MeshUse *mesh)
{
    const WorldDef *world = &check->scene->world;
    const MeshUse *odd = !mesh ? first_odd(world) : is_odd(world, mesh) ? mesh : NULL;
    const size_t used = check->error && odd ? strlen(check->error->message) : 0;
    if (used > 0)
        snprintf(
            check->error->message + used, sizeof check->error->message - used,
            ". %s is %.3g m long at its scale of %g; is the scale right (0.001 where its file counts millimetres)?",
            name_of(odd), length_of(odd), odd->scale);
    return false;
}

/* ---- reports ---- */

static void say_size(const Reader *reader, const char *key, const MeshUse *mesh)
{
    const double length = length_of(mesh), box = diagonal_of(&reader->check.scene->world);
    if (length > box)
        advise(
            reader->check.tree, key, reader->notes,
            "%s is %.3g m long at its scale of %g, more than the box of %.3g m from corner to corner; is the "
            "scale right (0.001 where its file counts millimetres)?",
            name_of(mesh), length, mesh->scale, box);
}

/* Reports overlapping parts, with the share of the volume. */
static void say_overlap(const Reader *reader, const char *key, const char *file, const MeshShape *shape,
                        const MeshState *state)
{
    const double twice = shape->excess.volume / (shape->volume + shape->excess.volume);
    char weighs[80] = "", cuts[80] = "its parts overlap";
    if (twice >= 1e-4)
        snprintf(weighs, sizeof weighs, ", and %.2g %% of it, which several enclose, weighs once",
                 100 * twice);
    else if (state->cutting == 0)
        return;
    if (state->cutting > 0)
        snprintf(cuts, sizeof cuts, "the mesh cuts itself, at %s%zu pair%s of triangles",
                 state->all_looked_at ? "" : "at least ", state->cutting, plural(state->cutting));
    advise(reader->check.tree, key, reader->notes, "%s: %s; what any part encloses is solid%s", file, cuts,
           weighs);
}

/* Reports repaired faults and faults beyond repair. */
static void say_state(const Reader *reader, const char *key, const char *file, const MeshShape *shape,
                      const MeshState *state)
{
    const TrianglesState *triangles = &state->triangles;
    if (triangles->inside_out)
        advise(reader->check.tree, key, reader->notes, "%s: the mesh is inside out; its faces are turned",
               file);
    if (triangles->turned > 0)
        advise(reader->check.tree, key, reader->notes,
               "%s: %zu of its parts %s inside out; %s faces are turned", file, triangles->turned,
               triangles->turned == 1 ? "is" : "are", triangles->turned == 1 ? "its" : "their");
    if (triangles->flat > 0)
        advise(reader->check.tree, key, reader->notes,
               "%s: %zu of its triangles ha%s no area and are left out", file, triangles->flat,
               triangles->flat == 1 ? "s" : "ve");
    if (triangles->doubled > 0)
        advise(reader->check.tree, key, reader->notes,
               "%s: %zu of its triangles lie%s on another one with the same corners and %s left out", file,
               triangles->doubled, triangles->doubled == 1 ? "s" : "",
               triangles->doubled == 1 ? "is" : "are");
    if (state->coarse[0])
        advise(reader->check.tree, key, reader->notes, "%s: %s", file, state->coarse);
    say_overlap(reader, key, file, shape, state);
}

static void say_mesh(const Reader *reader, const char *key, const MeshUse *mesh, const MeshState *state)
{
    say_state(reader, key, name_of(mesh), mesh->shape, state);
    say_size(reader, key, mesh);
}

static bool find(const Reader *reader, const char *file, char path[1200], Error *why)
{
    const char *scene = reader->check.tree->path;
    return reader->settings->recorded
               ? scene_recorded_path(scene, reader->settings->folder, file, path, why)
               : scene_beside_path(scene, file, path, why) && scene_file_is_there(scene, file, path, why);
}

static bool read_one(const Reader *reader, const char *key, MeshUse *mesh)
{
    const Check *check = &reader->check;
    char path[1200];
    MeshState state = {.cutting = 0};
    Error why = {""};
    if (check->scene->world.dimensions == 2)
        return FAIL(check, key, "a 2D scene has no meshes; write another shape");
    if (find(reader, mesh->file, path, &why))
        mesh->shape = mesh_file_load(path, &state, &why);
    if (!mesh->shape && !reader->settings->recorded)
        return FAIL(check, key, "%s: %s", name_of(mesh), why.message);
    if (!reader->notes)
        return true;
    if (mesh->shape)
        say_mesh(reader, key, mesh, &state);
    else
        notes_add(reader->notes, "%s: %.200s; it is not drawn", name_of(mesh), why.message);
    return true;
}

bool scene_read_meshes(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error)
{
    const Reader reader = {{tree, scene, error}, settings, notes};
    char key[96];
    for (int f = 0; f < scene->world.fluid_count; f++)
        for (int i = 0; i < scene->world.fluids[f].fill_count; i++) {
            Fill *fill = &scene->world.fluids[f].fills[i];
            snprintf(key, sizeof key, "fluids[%d].fill[%d].mesh.file", f, i);
            if (fill->kind == FILL_MESH && !read_one(&reader, key, &fill->mesh))
                return false;
        }
    for (int k = 0; k < scene->world.solid_count; k++) {
        SolidDef *solid = &scene->world.solids[k];
        snprintf(key, sizeof key, "solids[%d].mesh.file", k);
        if (solid->kind == SOLID_MESH && !read_one(&reader, key, &solid->mesh))
            return false;
    }
    return true;
}
