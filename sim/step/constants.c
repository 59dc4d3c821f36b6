#include "sim/step/constants.h"

#include "sim/flow/flow.h"
#include "sim/step/method.h"

#include <math.h>
#include <string.h>

static bool positive(double value)
{
    return value > 0 && isfinite(value);
}

static double length2(const double v[3])
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/* False with the reason for a count without a list. */
static bool list_check(const void *list, int count, const char *what, Error *error)
{
    return list || count <= 0 || error_set(error, "%d %s, but no list of them", count, what);
}

static bool lists_check(const WorldDef *def, Error *error)
{
    bool all = list_check(def->motions, def->motion_count, "motions", error) &&
               list_check(def->drains, def->drain_count, "drains", error);
    for (int f = 0; all && f < def->fluid_count && f < FLUIDS_MAX; f++)
        all = list_check(def->fluids[f].fills, def->fluids[f].fill_count, "fills", error) &&
              list_check(def->fluids[f].emits, def->fluids[f].emit_count, "emitters", error);
    for (int k = 0; all && k < def->solid_count && k < SOLIDS_MAX; k++)
        all = list_check(def->solids[k].motions, def->solids[k].motion_count, "motions of a solid", error);
    return all;
}

static bool motions_check(const Motion *motions, int count, int dimensions, Error *error)
{
    if (count < 0 || count > MOTIONS_MAX)
        return error_set(error, "up to %d motions act together, not %d", MOTIONS_MAX, count);
    for (int i = 0; i < count; i++) {
        const Motion *m = &motions[i];
        if (!positive(length2(m->axis)) || (m->kind == MOTION_TURN && !positive(m->duration)))
            return error_set(error, "motion %d: the axis must not be zero, nor the duration of a turn", i);
        if (dimensions == 2 && !motion_in_plane(m))
            return error_set(error, "motion %d: leaves the plane of a 2D scene", i);
    }
    return true;
}

static bool shape_check(const SolidDef *solid, int dimensions)
{
    switch (solid->kind) {
    case SOLID_BOX:
        return positive(solid->size[0]) && positive(solid->size[1]) &&
               (dimensions == 2 || positive(solid->size[2])) &&
               (solid->angle_deg == 0 || positive(length2(solid->axis)));
    case SOLID_CYLINDER:
        return dimensions == 3 && positive(solid->radius) && positive(solid->height) &&
               positive(length2(solid->axis));
    case SOLID_BOWL:
        return positive(solid->radius) && positive(solid->thickness) && positive(length2(solid->axis));
    case SOLID_MESH:
        return dimensions == 3 && solid->mesh.shape && positive(solid->mesh.scale) &&
               positive(length2(solid->axis));
    default:
        return positive(solid->radius);
    }
}

/* True for a box rotated about z, or a bowl with its axis in the plane; z of the centre must be 0. */
static bool solid_in_plane(const SolidDef *solid)
{
    const double *axis = solid->axis;
    return solid->centre[2] == 0 &&
           (solid->kind != SOLID_BOX || solid->angle_deg == 0 || (axis[0] == 0 && axis[1] == 0)) &&
           (solid->kind != SOLID_BOWL || axis[2] == 0);
}

/* Checks a floating solid. */
static bool floats_check(const WorldDef *def, int index, Error *error)
{
    const SolidDef *solid = &def->solids[index];
    const double *axis = solid->hinge_axis;
    const bool hinged = axis[0] != 0 || axis[1] != 0 || axis[2] != 0;
    if (!(solid->density >= 0) || !isfinite(solid->density))
        return error_set(error, "solid %d: its density must be positive", index);
    if (solid_floats(solid) && solid->motion_count > 0)
        return error_set(error, "solid %d: has a density, and fluid moves it: it can have no motions", index);
    if (solid_floats(solid) && (def->periodic[0] || def->periodic[1] || def->periodic[2]))
        return error_set(error, "solid %d: has a density, and needs a box with walls all round", index);
    if (def->dimensions == 2 && hinged && (axis[0] != 0 || axis[1] != 0))
        return error_set(error, "solid %d: in 2D a hinge's axis is 0 0 1", index);
    return true;
}

static bool solids_check(const WorldDef *def, Error *error)
{
    if (def->solid_count < 0 || def->solid_count > SOLIDS_MAX)
        return error_set(error, "a world has up to %d solids, not %d", SOLIDS_MAX, def->solid_count);
    for (int i = 0; i < def->solid_count; i++) {
        const SolidDef *solid = &def->solids[i];
        if (!shape_check(solid, def->dimensions))
            return error_set(
                error, "solid %d: lengths must be positive, an axis not zero, no cylinder or mesh in 2D", i);
        if (def->dimensions == 2 && !solid_in_plane(solid))
            return error_set(error, "solid %d: leaves the plane of a 2D scene", i);
        if (!motions_check(solid->motions, solid->motion_count, def->dimensions, error) ||
            !floats_check(def, i, error))
            return false;
    }
    return true;
}

static bool fills_check(const FluidDef *fluid, int dimensions)
{
    for (int i = 0; i < fluid->fill_count; i++)
        if (fluid->fills[i].kind == FILL_CYLINDER &&
            (dimensions != 3 || !positive(length2(fluid->fills[i].axis))))
            return false;
        else if (fluid->fills[i].kind == FILL_MESH &&
                 (dimensions != 3 || !fluid->fills[i].mesh.shape || !positive(fluid->fills[i].mesh.scale) ||
                  !positive(length2(fluid->fills[i].axis))))
            return false;
    return true;
}

static bool fluids_check(const WorldDef *def, Error *error)
{
    if (def->fluid_count < 1 || def->fluid_count > FLUIDS_MAX)
        return error_set(error, "a world needs 1 to %d fluids, not %d", FLUIDS_MAX, def->fluid_count);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        if (!positive(fluid->density) || !(fluid->viscosity >= 0) || !(fluid->surface_tension >= 0))
            return error_set(
                error, "fluid %d: density must be positive, viscosity and surface tension not negative", f);
        if (!(fluid->contact_angle >= 0 && fluid->contact_angle <= 180))
            return error_set(error, "fluid %d: a contact angle is 0 to 180 degrees", f);
        if (!time_table_sound(&fluid->viscosity_table))
            return error_set(
                error,
                "fluid %d: a table of viscosity has up to %d rows, whose times must ascend and whose values must not be negative",
                f, TIME_TABLE_ROWS);
        if (fluid->fill_count > FILLS_MAX)
            return error_set(error, "a fluid has up to %d fills, not %d", FILLS_MAX, fluid->fill_count);
        if (!fills_check(fluid, def->dimensions))
            return error_set(error, "fluid %d: the axis of a cylinder must not be zero; no cylinder in 2D",
                             f);
    }
    return true;
}

/* Checks settings for periodic sides. */
static bool periodic_check(const WorldDef *def, Error *error)
{
    const double h = def->support * def->spacing;
    bool any = false;
    for (int k = 0; k < 3; k++) {
        any |= def->periodic[k];
        if (def->periodic[k] && k >= def->dimensions)
            return error_set(error, "a 2D scene has no sides in z that could be periodic");
        if (def->periodic[k] && !(def->box_size[k] >= 2 * h))
            return error_set(error,
                             "along a periodic axis the box must be two support radii wide, %g m, not %g m; "
                             "use a smaller spacing",
                             2 * h, def->box_size[k]);
    }
    for (int i = 0; i < def->motion_count; i++)
        if (any && !motion_translates(&def->motions[i]))
            return error_set(error,
                             "motion %d: a box with periodic sides does not turn; shake or accelerate it", i);
    for (int i = 0; i < def->solid_count; i++)
        for (int k = 0; k < 3; k++)
            if (def->periodic[k] &&
                !solid_between(&def->solids[i], def->dimensions, k, k == 1 ? 0 : -0.5 * def->box_size[k],
                               k == 1 ? def->box_size[1] : 0.5 * def->box_size[k]))
                return error_set(
                    error, "solid %d reaches over a periodic side, or may come there; keep it inside the box",
                    i);
    return true;
}

/* Curvature requires particles evenly spread at the surface, as not all methods provide. */
static bool tension_check(const WorldDef *def, Error *error)
{
    const Method *method = method_find(def->method);
    bool any = false;
    for (int f = 0; f < def->fluid_count; f++)
        any |= def->fluids[f].surface_tension > 0;
    if (!any || def->tension_model != TENSION_CURVATURE || method->curvature)
        return true;
    for (const Method *const *has = method_list(); *has; has++)
        if ((*has)->curvature)
            return error_set(error,
                             "method %s has no surface tension by curvature; use method %s, or cohesion",
                             def->method, (*has)->name);
    return false;
}

static bool def_check(const WorldDef *def, Error *error)
{
    if (def->dimensions != 2 && def->dimensions != 3)
        return error_set(error, "a world has 2 or 3 dimensions, not %d", def->dimensions);
    if (def->dimensions == 2 && def->gravity[2] != 0)
        return error_set(error, "gravity leaves the plane of a 2D scene");
    for (int k = 0; k < def->dimensions; k++)
        if (!positive(def->box_size[k]))
            return error_set(error, "the box has no size; give three positive lengths in metres");
    if (!(def->spacing >= 1e-7 && def->spacing <= 1e4)) /* range in which all sums fit in floats */
        return error_set(error, "spacing must be 1e-7 to 1e4 m, not %g m", def->spacing);
    if (!(def->support >= 1.5 && def->support <= 4))
        return error_set(error, "support must be 1.5 to 4 spacings");
    if (!positive(def->dt) || def->substeps < 1 || !positive(def->sound_speed))
        return error_set(error, "dt and sound_speed must be positive, substeps at least 1");
    if (def->wall_slip != SLIP_FREE && def->wall_slip != SLIP_NONE)
        return error_set(error, "the walls' slip is free or none");
    if (!(def->jitter >= 0 && def->jitter <= 0.5))
        return error_set(error, "jitter is 0 to 0.5");
    for (const Method *const *method = method_list(); *method; method++)
        if ((*method)->check && !(*method)->check(def, error))
            return false;
    if (length2(def->lid) > 0 && (def->wall_slip != SLIP_NONE || def->lid[1] != 0 || def->periodic[1] ||
                                  !isfinite(length2(def->lid)) || (def->dimensions == 2 && def->lid[2] != 0)))
        return error_set(error,
                         "a lid moves in its plane, the top of a box whose walls hold fluid: slip none");
    if (!isfinite(def->gravity[0] + def->gravity[1] + def->gravity[2]))
        return error_set(error, "gravity must be finite");
    return lists_check(def, error) && fluids_check(def, error) && tension_check(def, error) &&
           motions_check(def->motions, def->motion_count, def->dimensions, error) &&
           solids_check(def, error) && flow_check(def, error) && periodic_check(def, error);
}

static void periodic_set(Periodic *periodic, const WorldDef *def)
{
    for (int k = 0; k < 3; k++) {
        periodic->axis[k] = def->periodic[k];
        periodic->any |= def->periodic[k];
        periodic->size[k] = (float)def->box_size[k];
        periodic->low[k] = k == 1 ? 0 : -0.5F * (float)def->box_size[k];
    }
}

static bool cells_set(CellGrid *cells, const WorldDef *def, double h, Error *error)
{
    double count = 1;
    for (int k = 0; k < 3; k++) {
        const double size = k < def->dimensions ? def->box_size[k] : 0, low = k == 1 ? 0 : -0.5 * size;
        const double whole = floor(size / h * (1 + 1e-6));
        const double first = def->periodic[k] ? -1 : floor(low / h) - 1,
                     last = def->periodic[k] ? whole : floor((low + size) / h) + 1;
        count *= last - first + 1;
        /* whole numbers up to 2^24 are exact in single precision */
        if (!(count < 0x1p31) || !(last - first < 0x1p24))
            return error_set(
                error,
                "the box holds more than 2^31 cells of side %g m, or 2^24 along an axis; use a larger spacing",
                h);
        cells->origin[k] = def->periodic[k] ? (float)low : 0;
        cells->inverse[k] = def->periodic[k] ? (float)(whole / size) : 1 / (float)h;
        cells->first[k] = (int)first;
        cells->size[k] = (int)(last - first) + 1;
    }
    cells->count = (size_t)count;
    return true;
}

static void fluids_set(Constants *constants, const WorldDef *def)
{
    const double c2 = def->sound_speed * def->sound_speed * constants->lattice.stiffness_scale;
    constants->stiffness_scale = (float)constants->lattice.stiffness_scale;
    constants->fluid_count = def->fluid_count;
    constants->negative_pressure = def->negative_pressure;
    constants->reproducible = def->reproducible;
    constants->viscous = constants->varies = false;
    bool named = false;
    constants->sound_speed = (float)def->sound_speed;
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const bool names = fluid_viscosity_most(fluid) > 0;
        constants->mass[f] =
            (float)(fluid->density / (constants->lattice.number_density * constants->unit_volume));
        constants->density[f] = (float)fluid->density;
        constants->stiffness[f] = (float)(c2 * fluid->density);
        constants->viscosity[f] = (float)step_viscosity(def, &constants->friction, f);
        constants->viscous |= names || constants->viscosity[f] > 0;
        named |= names;
        constants->varies |= fluid->viscosity_table.rows > 0;
    }
    constants->accelerations = def->acceleration;
    constants->implicit.named = def->viscosity_solver == VISCOSITY_IMPLICIT;
    constants->implicit.on = constants->viscous && constants->implicit.named;
    constants->implicit.tolerance = def->viscosity_tolerance;
    constants->implicit.most = def->viscosity_iterations;
    constants->rubs = constants->viscous && !constants->implicit.on;
    constants->holds = named;
    constants->no_slip = named && def->wall_slip == SLIP_NONE;
    constants->lid = constants->no_slip && length2(def->lid) > 0;
    for (int k = 0; k < 3; k++)
        constants->lid_velocity[k] = (float)def->lid[k];
}

/* Sets the method's constants. */
static void own_set(Constants *constants, const WorldDef *def)
{
    const Method *method = method_find(def->method);
    if (method->constants)
        method->constants(constants, def);
}

/* The kernel that weights pairs in implicit friction. */
static const Kernel *friction_kernel(const WorldDef *def)
{
    const Kernel *own = method_kernels(def).slope;
    for (int k = 0; k < SHAPE_KERNELS; k++)
        if (own == &shape_kernels[k])
            return own;
    return &shape_kernels[KERNEL_WENDLAND_C2];
}

static void implicit_set(Constants *constants, const WorldDef *def, Lattice *lattice)
{
    /* f(q) = -w'(q) / q at q = 1/2, as in sim/cpu/pair_loop.h */
    static const double half[SHAPE_KERNELS] = {
        [KERNEL_CUBIC] = 3, [KERNEL_WENDLAND_C2] = 2.5, [KERNEL_QUINTIC] = (5.0625 - 6 * 0.0625) / 0.5};
    const double h = def->support * def->spacing, r = 0.5 * h;
    const Kernel *kernel = friction_kernel(def);
    ImplicitViscosity *implicit = &constants->implicit;
    lattice_calibrate(def->dimensions, def->spacing, h, kernel, kernel, lattice);
    implicit->kernel = (ShapeKernel)(kernel - shape_kernels);
    implicit->scale = (float)(-kernel->derivative(r, h) / r / half[implicit->kernel] *
                              lattice->gradient_scale * lattice->radial_scale * constants->unit_volume);
}

/* Creates tables of wall friction if needed and missing. */
static bool drag_set(Constants *constants, const WorldDef *def, Error *error)
{
    bool needed = false;
    for (int f = 0; f < def->fluid_count; f++)
        needed |= def->wall_slip == SLIP_NONE && fluid_viscosity_most(&def->fluids[f]) > 0;
    const bool implicit = def->viscosity_solver == VISCOSITY_IMPLICIT;
    Lattice lattice = constants->lattice;
    if (implicit)
        implicit_set(constants, def, &lattice);
    if (!needed || constants->drag.table[0] ||
        wall_drag_create(&constants->drag, def->box_size, def->periodic, def->spacing,
                         def->support * def->spacing, &lattice, constants->unit_volume,
                         implicit ? DRAG_RADIAL : constants->friction.walls))
        return true;
    return error_set(error, "no memory for the friction of the walls");
}

static void tension_set(Constants *constants, const WorldDef *def)
{
    const double h = def->support * def->spacing;
    const double u = constants->unit, volume = constants->unit_volume;
    double scale = 1;
    if (def->tension_model == TENSION_COHESION) /* kernel in u^6, times x / u */
        scale = cohesion_scale(def->dimensions, def->spacing, h) * volume * pow(u, 5);
    if (def->tension_model == TENSION_CURVATURE) {
        constants->curvature = curvature_calibrate(def->dimensions, def->spacing, h);
        scale = pow(def->spacing, def->dimensions - 1) / constants->curvature.layers / volume;
    }
    bool any = false;
    for (int f = 0; f < def->fluid_count; f++) {
        constants->wet[f] = (float)wetting_curvature(def->fluids[f].contact_angle, def->spacing, h);
        constants->tension[f] = (float)(scale * def->fluids[f].surface_tension);
        any |= def->fluids[f].surface_tension > 0;
    }
    constants->colour = (float)(colour_scale(def->dimensions, h) * volume * pow(u, 4));
    constants->tension_model = any ? (TensionModel)def->tension_model : TENSION_NONE;
}

bool constants_create(Constants *constants, const WorldDef *def, Error *error)
{
    memset(constants, 0, sizeof *constants);
    const double h = def->support * def->spacing;
    const Method *method = method_find(def->method);
    const MethodKernels kernels = method_kernels(def);
    const Kernel *kernel = kernels.density;
    if (!kernel)
        return error_set(error, "unknown kernel; `slosh info` lists them");
    if (!def_check(def, error) || !cells_set(&constants->cells, def, h, error))
        return false;

    periodic_set(&constants->periodic, def);
    constants->first_row = def->dimensions == 2 ? 3 : 0;
    constants->last_row = def->dimensions == 2 ? 6 : 9;
    lattice_calibrate(def->dimensions, def->spacing, h, kernel, kernels.slope, &constants->lattice);
    constants->friction = step_friction(def);
    constants->method = method;
    constants->support_radius = (float)h;
    constants->unit = ldexp(1, ilogb(def->spacing));
    constants->unit_volume = pow(constants->unit, def->dimensions);
    constants->spacing = (float)def->spacing;
    constants->rest_number_density = (float)(constants->lattice.number_density * constants->unit_volume);
    constants->kernel_scale =
        (float)(kernel->value(0, h) * constants->lattice.density_scale * constants->unit_volume);
    constants->viscosity_scale = (float)(kernel_viscosity_laplacian(0, h) *
                                         constants->lattice.laplacian_scale * constants->unit_volume);
    tension_set(constants, def);
    fluids_set(constants, def);
    own_set(constants, def);
    walls_place(&constants->walls, def->dimensions, def->box_size, def->periodic, def->spacing);
    constants->lift = wall_lift_of(&constants->lattice, def->spacing, h);
    constants->dimensions = def->dimensions;
    constants->wide = columns_wide(def);
    constants->emits = flow_emits(def);
    constants->drains = def->drain_count > 0;
    constants->solid_count = def->solid_count;
    memcpy(constants->solids, def->solids, sizeof constants->solids);
    if (!boundary_create(&constants->boundary, def))
        return error_set(error, "no memory for the boundary particles of the solids");
    return drag_set(constants, def, error);
}

bool constants_change(Constants *constants, const WorldDef *def, Error *error)
{
    if (!def_check(def, error) || !drag_set(constants, def, error))
        return false;
    fluids_set(constants, def);
    own_set(constants, def);
    return true;
}

bool constants_vary(Constants *constants, const WorldDef *def)
{
    bool other = false;
    for (int f = 0; f < def->fluid_count; f++) {
        const float now = (float)step_viscosity(def, &constants->friction, f);
        other |= constants->viscosity[f] != now;
        constants->viscosity[f] = now;
    }
    return other;
}

void constants_destroy(Constants *constants)
{
    boundary_destroy(&constants->boundary);
    wall_drag_destroy(&constants->drag);
}
