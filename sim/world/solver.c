#include "sim/world/solver.h"

#include "sim/matter/flow.h"

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

static bool grid_check(const WorldDef *def, Error *error)
{
    return (def->grid_layers >= 0 && def->lost_limit >= 0) ||
           error_set(error, "grid_layers and lost_limit must not be negative");
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
    default:
        return positive(solid->radius);
    }
}

/* A box that turns about z, a bowl whose axis is in the plane, and none before or behind it. */
static bool solid_in_plane(const SolidDef *solid)
{
    const double *axis = solid->axis;
    return solid->centre[2] == 0 &&
           (solid->kind != SOLID_BOX || solid->angle_deg == 0 || (axis[0] == 0 && axis[1] == 0)) &&
           (solid->kind != SOLID_BOWL || axis[2] == 0);
}

static bool solids_check(const WorldDef *def, Error *error)
{
    if (def->solid_count < 0 || def->solid_count > SOLIDS_MAX)
        return error_set(error, "a world has up to %d solids, not %d", SOLIDS_MAX, def->solid_count);
    for (int i = 0; i < def->solid_count; i++) {
        const SolidDef *solid = &def->solids[i];
        if (!shape_check(solid, def->dimensions))
            return error_set(error, "solid %d: lengths must be positive, an axis not zero, no cylinder in 2D",
                             i);
        if (def->dimensions == 2 && !solid_in_plane(solid))
            return error_set(error, "solid %d: leaves the plane of a 2D scene", i);
        if (!motions_check(solid->motions, solid->motion_count, def->dimensions, error))
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
        if (!time_table_sound(&fluid->viscosity_table))
            return error_set(
                error,
                "fluid %d: a table of viscosity has up to %d rows, whose times must ascend and whose values must not be negative",
                f, TIME_TABLE_ROWS);
        if (!fills_check(fluid, def->dimensions))
            return error_set(error, "fluid %d: the axis of a cylinder must not be zero; no cylinder in 2D",
                             f);
    }
    return true;
}

/* Where the sides across an axis are one. */
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

static bool def_check(const WorldDef *def, Error *error)
{
    if (def->dimensions != 2 && def->dimensions != 3)
        return error_set(error, "a world has 2 or 3 dimensions, not %d", def->dimensions);
    if (def->dimensions == 2 && def->gravity[2] != 0)
        return error_set(error, "gravity leaves the plane of a 2D scene");
    for (int k = 0; k < def->dimensions; k++)
        if (!positive(def->box_size[k]))
            return error_set(error, "the box has no size; give three positive lengths in metres");
    if (!positive(def->spacing) || !(def->support >= 1.5 && def->support <= 4))
        return error_set(error, "spacing must be positive and support between 1.5 and 4 spacings");
    if (!positive(def->dt) || def->substeps < 1 || !positive(def->sound_speed))
        return error_set(error, "dt and sound_speed must be positive, substeps at least 1");
    if (def->wall_slip != SLIP_FREE && def->wall_slip != SLIP_NONE)
        return error_set(error, "the walls' slip is free or none");
    if (def->viscosity_form != VISCOSITY_MORRIS && def->viscosity_form != VISCOSITY_RADIAL)
        return error_set(error, "the form of viscosity is morris or radial");
    if (!(def->shifting >= 0 && def->shifting <= 1) || !(def->jitter >= 0 && def->jitter <= 0.5))
        return error_set(error, "shifting is 0 to 1, jitter 0 to 0.5");
    if (length2(def->lid) > 0 && (def->wall_slip != SLIP_NONE || def->lid[1] != 0 || def->periodic[1] ||
                                  !isfinite(length2(def->lid)) || (def->dimensions == 2 && def->lid[2] != 0)))
        return error_set(error,
                         "a lid moves in its plane, the top of a box whose walls hold fluid: slip none");
    if (!isfinite(def->gravity[0] + def->gravity[1] + def->gravity[2]))
        return error_set(error, "gravity must be finite");
    return fluids_check(def, error) &&
           motions_check(def->motions, def->motion_count, def->dimensions, error) && grid_check(def, error) &&
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

static void fluids_set(Solver *solver, const WorldDef *def)
{
    const double compression = solver->lattice.stiffness_scale;
    const double c2 = def->sound_speed * def->sound_speed * compression;
    solver->compression = (float)compression;
    solver->fluid_count = def->fluid_count;
    solver->negative_pressure = def->negative_pressure;
    solver->reproducible = def->reproducible;
    solver->viscous = solver->varies = false;
    const double reach = 0.5 * def->support * def->spacing, c = def->sound_speed;
    solver->diffusion = (float)(2 * def->delta_sph * c * reach);
    solver->sound_speed = (float)c;
    solver->shifting = solver->continuity ? (float)(def->shifting * c * reach) : 0;
    solver->artificial = false;
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const bool viscous = fluid_viscosity_most(fluid) > 0;
        const double alpha = viscous ? 0 : def->artificial_viscosity;
        solver->tait[f] = (float)(fluid->density * c * c / 7);
        solver->artificial_viscosity[f] = (float)(0.5 * alpha * c * reach * fluid->density);
        solver->artificial |= alpha > 0;
        solver->mass[f] = (float)(fluid->density / solver->lattice.number_density);
        solver->density[f] = (float)fluid->density;
        solver->stiffness[f] = (float)(c2 * fluid->density);
        solver->viscosity[f] = (float)fluid->viscosity;
        solver->viscous |= viscous;
        solver->varies |= fluid->viscosity_table.rows > 0;
    }
    solver->no_slip = solver->viscous && def->wall_slip == SLIP_NONE;
    solver->lid = solver->no_slip && length2(def->lid) > 0;
    for (int k = 0; k < 3; k++)
        solver->lid_velocity[k] = (float)def->lid[k];
}

static DragWeight drag_weight_of(const Solver *solver)
{
    return !solver->continuity ? DRAG_MUELLER : solver->radial > 0 ? DRAG_RADIAL : DRAG_MORRIS;
}

/* The tables of what the walls do, as far as the def needs them and they are not there. */
static bool drag_set(Solver *solver, const WorldDef *def, Error *error)
{
    bool needed = false;
    for (int f = 0; f < def->fluid_count; f++)
        needed |= def->wall_slip == SLIP_NONE && fluid_viscosity_most(&def->fluids[f]) > 0;
    if (!needed || solver->drag.table[0] ||
        wall_drag_create(&solver->drag, def->box_size, def->periodic, def->spacing,
                         def->support * def->spacing, &solver->lattice, drag_weight_of(solver)))
        return true;
    return error_set(error, "no memory for the friction of the walls");
}

/* -W'(r) / r at the radius where f(q) = -w'(q) / q is known best, over f there. */
static void wcsph_set(Solver *solver, const WorldDef *def, const Kernel *kernel, double h)
{
    static const double f_half[] = {[KERNEL_CUBIC] = 3,
                                    [KERNEL_WENDLAND_C2] = 2.5,
                                    [KERNEL_QUINTIC] = (1.5 * 1.5 * 1.5 * 1.5 - 6 * 0.0625) / 0.5};
    const double r = 0.5 * h, scale = solver->lattice.gradient_scale;
    solver->kernel = (WcsphKernel)(kernel - wcsph_kernels);
    if (def->viscosity_form == VISCOSITY_RADIAL)
        solver->radial = (float)solver->lattice.radial_scale;
    solver->gradient = (float)(-kernel->derivative(r, h) / r * scale / f_half[solver->kernel]);
}

static void tension_set(Solver *solver, const WorldDef *def)
{
    const double h = def->support * def->spacing;
    const double scale =
        def->tension_model == TENSION_COHESION ? cohesion_scale(def->dimensions, def->spacing, h) : 1;
    bool any = false;
    for (int f = 0; f < def->fluid_count; f++) {
        solver->tension[f] = (float)(scale * def->fluids[f].surface_tension);
        any |= def->fluids[f].surface_tension > 0;
    }
    solver->colour = (float)colour_scale(def->dimensions, h);
    solver->tension_model = any ? (TensionModel)def->tension_model : TENSION_NONE;
}

/* The lattice puts ceil(support)^dimensions particles into a cell at most. */
static int layers_for(const WorldDef *def)
{
    const double most = pow(ceil(def->support), def->dimensions);
    return def->grid_layers > 0 ? def->grid_layers : (int)ceil(most / 4);
}

bool solver_create(Solver *solver, const WorldDef *def, Error *error)
{
    memset(solver, 0, sizeof *solver);
    const double h = def->support * def->spacing;
    const bool continuity = strcmp(def->method, "wcsph") == 0;
    const Kernel *kernel =
        continuity ? wcsph_kernel_find(def->kernel) : density_kernel_find(def->density_kernel);
    if (!kernel)
        return error_set(error, "unknown kernel '%s'; `slosh info` lists them",
                         continuity ? def->kernel : def->density_kernel);
    if (!def_check(def, error) || !cells_set(&solver->cells, def, h, error))
        return false;

    periodic_set(&solver->periodic, def);
    solver->first_row = def->dimensions == 2 ? 3 : 0;
    solver->last_row = def->dimensions == 2 ? 6 : 9;
    lattice_calibrate(def->dimensions, def->spacing, h, kernel,
                      continuity ? kernel : density_kernel_find("spiky"), &solver->lattice);
    solver->friction = step_friction(def);
    solver->continuity = continuity;
    solver->poly6 = kernel->value == kernel_poly6;
    solver->support_radius = (float)h;
    solver->spacing = (float)def->spacing;
    solver->rest_number_density = (float)solver->lattice.number_density;
    solver->kernel_scale = (float)(kernel->value(0, h) * solver->lattice.density_scale);
    solver->pressure_scale = (float)(-kernel_spiky_derivative(0, h) * solver->lattice.gradient_scale);
    solver->viscosity_scale = (float)(kernel_viscosity_laplacian(0, h) * solver->lattice.laplacian_scale);
    tension_set(solver, def);
    if (continuity)
        wcsph_set(solver, def, kernel, h);
    fluids_set(solver, def);
    if (continuity)
        walls_place(&solver->walls, def->dimensions, def->box_size, def->periodic, def->spacing);
    else if (!walls_create(&solver->walls, def->box_size, def->periodic, def->spacing, h, kernel,
                           &solver->lattice))
        return error_set(error, "no memory for the tables of the walls");
    solver->dimensions = def->dimensions;
    solver->emits = flow_emits(def);
    solver->drains = def->drain_count > 0;
    solver->grid_layers = layers_for(def);
    solver->lost_limit = (size_t)def->lost_limit;
    solver->solid_count = def->solid_count;
    memcpy(solver->solids, def->solids, sizeof solver->solids);
    if (!boundary_create(&solver->boundary, def))
        return error_set(error, "no memory for the boundary particles of the solids");
    return drag_set(solver, def, error);
}

bool solver_change(Solver *solver, const WorldDef *def, Error *error)
{
    if (!def_check(def, error) || !drag_set(solver, def, error))
        return false;
    fluids_set(solver, def);
    return true;
}

bool solver_vary(Solver *solver, const WorldDef *def)
{
    bool other = false;
    for (int f = 0; f < def->fluid_count; f++) {
        const float now = (float)def->fluids[f].viscosity;
        other |= solver->viscosity[f] != now;
        solver->viscosity[f] = now;
    }
    return other;
}

void solver_destroy(Solver *solver)
{
    walls_destroy(&solver->walls);
    boundary_destroy(&solver->boundary);
    wall_drag_destroy(&solver->drag);
}
