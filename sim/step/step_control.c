#include "sim/def/fluids.h"
#include "sim/start/start.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdio.h>

static const double GROWTH = 1.1, FIRST = 0.1;
static const float DENSITY_RATIO_MOST = 5;

const char *step_limit_name(StepLimit limit)
{
    static const char *const names[] = {
#define X(NAME, name, help) name,
        STEP_LIMITS(X)
#undef X
    };
    return names[limit];
}

const char *step_trouble_words(StepTrouble trouble)
{
    static const char *const words[] = {
#define X(NAME, text) text,
        STEP_TROUBLES(X)
#undef X
    };
    return words[trouble];
}

StepTrouble step_trouble_of(const StepWatch *watch, bool sentinel)
{
    if (watch->memory)
        return STEP_TROUBLE_MEMORY;
    if (!watch->bounded)
        return STEP_TROUBLE_SPEED;
    if (sentinel && watch->max_density_ratio > DENSITY_RATIO_MOST)
        return STEP_TROUBLE_DENSITY;
    return watch->lost > watch->lost_limit ? STEP_TROUBLE_LOST : STEP_TROUBLE_NONE;
}

StepFriction step_friction(const WorldDef *def)
{
    const Method *method = method_find(def->method);
    const MethodKernels kernels = method_kernels(def);
    Lattice lattice;
    lattice_calibrate(def->dimensions, def->spacing, def->support * def->spacing, kernels.density,
                      kernels.slope, &lattice);
    return method->friction ? method->friction(def, &lattice) : (StepFriction){0};
}

/* Half the pair viscosity with the most viscous fluid, over the density: the maximum over fluids. */
static double greatest_kinematic_viscosity(const WorldDef *def, const StepFriction *friction)
{
    double greatest = 0, most = 0;
    for (int f = 0; f < def->fluid_count; f++)
        most = fmax(most, step_viscosity(def, friction, f));
    for (int f = 0; f < def->fluid_count; f++)
        greatest = fmax(greatest, 0.5 * pair_viscosity(step_viscosity(def, friction, f), most) /
                                      def->fluids[f].density);
    return greatest;
}

double step_towards(double dt, double left)
{
    const double steps = ceil(left / dt - 1e-6);
    return steps >= 1 && steps <= 4 ? fmin(dt, left / steps) : dt;
}

double density_ratio(const WorldDef *def)
{
    double least = INFINITY, most = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        least = fmin(least, def->fluids[f].density);
        most = fmax(most, def->fluids[f].density);
    }
    return most / least;
}

double step_sound(const WorldDef *def)
{
    return method_find(def->method)->incompressible ? 0 : def->sound_speed;
}

double step_sound_calm(const WorldDef *def)
{
    return STEP_SOUND_CALM / method_kernels(def).density->stiffness;
}

double artificial_kinematic(const WorldDef *def, double alpha)
{
    return 0.25 * alpha * def->sound_speed * def->support * def->spacing;
}

double numerical_kinematic(const WorldDef *def, double alpha)
{
    return artificial_kinematic(def, alpha) / (def->dimensions + 2);
}

double step_viscosity(const WorldDef *def, const StepFriction *friction, int f)
{
    const FluidDef *fluid = &def->fluids[f];
    return fmax(fluid->viscosity, friction->numerical * fluid->density);
}

double step_alpha(const WorldDef *def, double alpha, int f)
{
    const FluidDef *fluid = &def->fluids[f];
    const double stands_for = numerical_kinematic(def, alpha) * fluid->density;
    return stands_for > 0 ? alpha * fmax(0, 1 - fluid_viscosity_least(fluid) / stands_for) : 0;
}

/* The greatest remaining artificial viscosity of a fluid. */
static double greatest_alpha(const WorldDef *def, double alpha)
{
    double greatest = 0;
    for (int f = 0; f < def->fluid_count; f++)
        greatest = fmax(greatest, step_alpha(def, alpha, f));
    return greatest;
}

double step_viscous(const WorldDef *def, const StepFriction *friction)
{
    const double laminar = def->viscosity_solver == VISCOSITY_IMPLICIT ? 0 : friction->laminar;
    const double rate =
        fmax(laminar * greatest_kinematic_viscosity(def, friction),
             friction->artificial * artificial_kinematic(def, greatest_alpha(def, friction->alpha)));
    return rate > 0 ? 2 / rate : INFINITY;
}

void step_advice(const WorldDef *def, const StepFriction *friction, StepTrouble trouble, double dt,
                 double max_speed, char words[200])
{
    const double crossing = def->support * def->spacing / step_sound(def), c = def->sound_speed;
    const bool sounds = !method_find(def->method)->incompressible;
    const char *shorter = def->step_mode == STEP_CFL ? "a smaller solver.step.number"
                                                     : "a smaller solver.step.dt, more solver.step.substeps";
    if (dt > STEP_SOUND_STANDS * crossing)
        snprintf(
            words, 200,
            "the step is %.2g times what sound takes to cross a support radius, %.1g at most holds; use %s or a lower solver.sound_speed",
            dt / crossing, STEP_SOUND_STANDS, shorter);
    else if (dt > STEP_VISCOUS_STANDS * step_viscous(def, friction))
        snprintf(words, 200, "friction stands %.3g ms, the step is %.3g ms; use %s or a lower viscosity",
                 1e3 * STEP_VISCOUS_STANDS * step_viscous(def, friction), 1e3 * dt, shorter);
    else if (sounds && (trouble == STEP_TROUBLE_DENSITY || 2 * max_speed > c))
        snprintf(words, 200,
                 "flow of %.3g m/s is much for a solver.sound_speed of %.3g m/s; use a higher one, and %s",
                 max_speed, c, shorter);
    else
        snprintf(words, 200, "use %s", shorter);
}

/* Damping rate of boiling by implicit friction, 1/s: of the least viscous fluid, over the heaviest fluid's
   density. Measured in a boiling column: 62 to 83 nu / h^2 (docs/labbook/failures.md). */
static double boiling_damped(const WorldDef *def)
{
    static const double DAMPED = 40;
    const double h = def->support * def->spacing;
    double least = INFINITY, heaviest = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        least = fmin(least, fluid_viscosity_least(&def->fluids[f]));
        heaviest = fmax(heaviest, def->fluids[f].density);
    }
    return def->viscosity_solver == VISCOSITY_IMPLICIT && def->fluid_count > 0
               ? DAMPED * least / (heaviest * h * h)
               : 0;
}

/* The support that counts for the stiffest wave of the lattice, m: beyond a shell of neighbours a greater
   support brings weight, and no neighbour that would soften the wave. */
static double stiff_reach(const WorldDef *def)
{
    static const double BEYOND = 1.05; /* 2.1 at the shell of 2 spacings, of which STEP_PRESSURE_STANDS is */
    const int most = (int)ceil(def->support * def->support) - 1, deep = def->dimensions == 3 ? 4 : 0;
    int shell = 0;
    for (int i = 0; i <= 4; i++)
        for (int j = 0; j <= 4; j++)
            for (int k = 0; k <= deep; k++) {
                const int squares = i * i + j * j + k * k;
                shell = squares <= most && squares > shell ? squares : shell;
            }
    return fmin(def->support, BEYOND * sqrt(shell)) * def->spacing;
}

/* With v' = (v - dt w^2 x) / (1 + dt r), x' = x + dt v', the scheme is stable up to (dt w)^2 = 4 + 2 r dt.
   Without damping the bound is w dt = 2, at `still`. */
double step_pressure(const WorldDef *def)
{
    const Method *method = method_find(def->method);
    const double *g = def->gravity, fall = greatest_fall(def),
                 speed = sqrt(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * fall);
    if (!method->incompressible || speed == 0)
        return INFINITY;
    if (method->leaps)
        return sqrt(STEP_FALL_STANDS * def->spacing * fall) / speed;
    const double still = STEP_PRESSURE_STANDS * stiff_reach(def) / speed,
                 damped = 0.25 * still * boiling_damped(def);
    return still * (damped + sqrt(damped * damped + 1));
}

double step_tension(const WorldDef *def)
{
    double rate = 0; /* sigma / rho */
    for (int f = 0; f < def->fluid_count && def->tension_model != TENSION_NONE; f++)
        rate = fmax(rate, def->fluids[f].surface_tension / def->fluids[f].density);
    const double a = def->spacing,
                 stands = method_find(def->method)->leaps ? STEP_TENSION_LEAPS : STEP_TENSION_STANDS;
    return rate > 0 ? stands * sqrt(a * a * a / (2 * M_PI * rate)) : INFINITY;
}

double step_cfl(const WorldDef *def, const StepFriction *friction, double max_speed, double max_acceleration,
                double before, StepLimit *binding)
{
    const double h = def->support * def->spacing, number = def->cfl_number;
    const double courant = number * h / (step_sound(def) + max_speed);
    /* Without sound, a blow ends within its step: the remaining `a` is a move and not a wave to follow. */
    const double follows = step_sound(def) > 0 ? number : sqrt(number);
    const double most[STEP_LIMIT_COUNT] = {
        [STEP_LIMIT_DT] = INFINITY,
        [STEP_LIMIT_COURANT] = courant, /* INFINITY at rest without sound */
        [STEP_LIMIT_FORCE] = max_acceleration > 0 ? follows * sqrt(h / max_acceleration) : INFINITY,
        [STEP_LIMIT_VISCOUS] = fmin(2 * number, STEP_VISCOUS_STANDS) * step_viscous(def, friction),
        [STEP_LIMIT_MAX_DT] = def->max_dt,
        [STEP_LIMIT_GROWTH] = before > 0 ? GROWTH * before : FIRST * fmin(courant, def->max_dt),
        [STEP_LIMIT_PRESSURE] = step_pressure(def),
        [STEP_LIMIT_TENSION] = step_tension(def),
    };
    *binding = STEP_LIMIT_DT;
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        if (most[i] < most[*binding])
            *binding = (StepLimit)i;
    return most[*binding];
}
