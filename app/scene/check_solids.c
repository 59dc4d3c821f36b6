#include "app/scene/check_parts.h"
#include "sim/matter/solid_step.h"
#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdio.h>

/* In two dimensions solids must lie in the plane. */
static bool check_solid_plane(const Check *check, const SolidDef *solid, const char *path)
{
    char key[96];
    if (check->scene->world.dimensions == 3)
        return true;
    if (solid->kind == SOLID_CYLINDER)
        return FAIL(check, path, "a 2D scene has no cylinders; write a sphere, which is a disc there");
    snprintf(key, sizeof key, "%s.%s.axis", path, solid_name(solid->kind));
    if (solid->kind == SOLID_BOX && solid->angle_deg != 0 && (solid->axis[0] != 0 || solid->axis[1] != 0))
        return FAIL(check, key, "a box in a 2D scene turns about [0, 0, 1]");
    if (solid->kind == SOLID_BOWL && !scene_check_plane(check, key, solid->axis))
        return false;
    snprintf(key, sizeof key, "%s.%s.centre", path, solid_name(solid->kind));
    return scene_check_plane(check, key, solid->centre);
}

/* A floating solid must not have its own motion, and only a floating solid may have a hinge. */
static bool check_floating(const Check *check, const SolidDef *solid, const char *path)
{
    const WorldDef *world = &check->scene->world;
    const bool hinged = solid->hinge_axis[0] != 0 || solid->hinge_axis[1] != 0 || solid->hinge_axis[2] != 0;
    char density[96], hinge[96], axis[96], at[96];
    snprintf(density, sizeof density, "%s.density", path);
    snprintf(hinge, sizeof hinge, "%s.hinge", path);
    snprintf(axis, sizeof axis, "%s.hinge.axis", path);
    snprintf(at, sizeof at, "%s.hinge.at", path);
    const bool offset = solid->hinge_at[0] != 0 || solid->hinge_at[1] != 0 || solid->hinge_at[2] != 0;
    const Node *node = tree_at(check->tree, hinge);
    if (!hinged && (offset || (node && !node->first)))
        return FAIL(check, hinge, "the hinge has no direction; write its `axis`, such as [0, 0, 1]");
    if (!solid_floats(solid))
        return !hinged ||
               FAIL(check, hinge, "nothing turns a solid without a density; write `density`, in kg/m3");
    if (solid->motion_count > 0)
        return FAIL(check, density,
                    "fluid moves a solid with a density; leave out its motion, or the density");
    if (world->periodic[0] || world->periodic[1] || world->periodic[2])
        return FAIL(check, density, "a solid that floats needs a box with walls; leave out box.periodic");
    if (world->dimensions == 2 && hinged && (solid->hinge_axis[0] != 0 || solid->hinge_axis[1] != 0))
        return FAIL(check, axis, "a hinge in a 2D scene has the axis [0, 0, 1]");
    return !hinged || scene_check_plane(check, at, solid->hinge_at);
}

bool scene_check_solid(const Check *check, int index)
{
    const SolidDef *solid = &check->scene->world.solids[index];
    char path[64], key[96];
    snprintf(path, sizeof path, "solids[%d]", index);
    snprintf(key, sizeof key, "%s.%s.axis", path, solid_name(solid->kind));
    if (!check_solid_plane(check, solid, path) ||
        (solid->kind != SOLID_SPHERE && !scene_check_axis(check, key, solid->axis)))
        return false;
    if (solid->motion_count == 0 && scene_outside_box(check, solid->centre) > solid_reach(solid))
        return FAIL(check, path, "the solid is outside the box, and does not move; no fluid comes there");
    if (!check_floating(check, solid, path))
        return false;
    snprintf(key, sizeof key, "%s.motion", path);
    for (int m = 0; m < solid->motion_count; m++)
        if (!scene_check_motion(check, key, m, &solid->motions[m]))
            return false;
    return true;
}

double scene_solid_width(const SolidDef *solid, int dimensions)
{
    switch (solid->kind) {
    case SOLID_BOX:
        return fmin(fmin(solid->size[0], solid->size[1]), dimensions == 3 ? solid->size[2] : INFINITY);
    case SOLID_CYLINDER:
        return fmin(2 * solid->radius, solid->height);
    case SOLID_BOWL:
        return solid->thickness;
    case SOLID_MESH:
        return solid->mesh.shape ? 2 * solid->mesh.scale * solid->mesh.shape->depth : INFINITY;
    default:
        return 2 * solid->radius;
    }
}

bool scene_check_widths(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    for (int k = 0; k < world->solid_count; k++) {
        const SolidDef *solid = &world->solids[k];
        const double width = scene_solid_width(solid, world->dimensions);
        char path[64];
        snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(solid->kind));
        if (!(width >= (1 - 1e-9) * world->spacing)) {
            FAIL(
                check, path,
                "the solid is %g m thin, less than the spacing of %g m; make it thicker (twice the spacing to "
                "keep fluids apart) or use a smaller spacing",
                width, world->spacing);
            return solid->kind == SOLID_MESH && scene_ask_scale(check, &solid->mesh);
        }
    }
    return true;
}
