/* Checks the step against friction, sound and tension, by sim/world/step_control.h. */
#include "app/scene/advise_parts.h"
#include "sim/matter/fall.h"
#include "sim/matter/fill.h"
#include "sim/matter/tension.h"
#include "sim/world/method.h"
#include "sim/world/step_control.h"

#include <math.h>

/* Writes the setting whose friction limits the step, as key and value. */
static void name_friction(const WorldDef *most, const StepFriction *friction, char name[64])
{
    const StepFriction laminar = {.laminar = friction->laminar};
    int thickest = 0;
    for (int f = 1; f < most->fluid_count; f++)
        thickest = most->fluids[f].viscosity > most->fluids[thickest].viscosity ? f : thickest;
    if (step_viscous(most, &laminar) > step_viscous(most, friction))
        snprintf(name, 64, "solver.artificial_viscosity %g", friction->alpha);
    else
        snprintf(name, 64, "fluids[%d].viscosity %g Pa s", thickest, most->fluids[thickest].viscosity);
}

static double substeps_for(const WorldDef *def, double step)
{
    return ceil(def->dt / step * (1 - 1e-9));
}

/* Warns if the step exceeds the limit by friction. */
static void advise_viscous(const Tree *tree, const WorldDef *def, const StepFriction *friction, Notes *notes)
{
    const double step = def->dt / def->substeps, stands = STEP_VISCOUS_STANDS * step_viscous(def, friction);
    char what[64];
    if (step <= stands)
        return;
    name_friction(def, friction, what);
    advise(
        tree, "solver.step.dt", notes,
        "the step of %.3g ms is too long for %s: from %.3g ms on friction %s; use %g substeps or more, or a "
        "lower viscosity",
        1e3 * step, what, 1e3 * stands,
        method_find(def->method)->leaps ? "is held to what a step stands, and fluid is thinner"
                                        : "makes fluid boil instead of calming it",
        substeps_for(def, stands));
}

void advise_step(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef def = world_def_most_viscous(&scene->world);
    const StepFriction friction = step_friction(&def);
    const double step = def.dt / def.substeps, crossing = def.support * def.spacing / step_sound(&def);
    if (def.step_mode == STEP_FIXED && step > STEP_SOUND_STANDS * crossing)
        advise(
            tree, "solver.step.dt", notes,
            "the step of %.3g ms is too long for sound at %g m/s, which crosses a support radius in %.3g ms: "
            "use %g substeps or more, or a lower solver.sound_speed",
            1e3 * step, step_sound(&def), 1e3 * crossing, substeps_for(&def, STEP_SOUND_CALM * crossing));
    else if (def.step_mode == STEP_FIXED && step > step_pressure(&def) * (1 + 1e-9))
        advise(
            tree, "solver.step.dt", notes,
            "the step of %.3g ms is too long for the pressure of fluid that is %.3g m deep: from %.3g ms on it "
            "boils; use %g substeps or more",
            1e3 * step, greatest_fall(&def), 1e3 * step_pressure(&def),
            substeps_for(&def, step_pressure(&def)));
    else if (def.step_mode == STEP_FIXED && step > step_tension(&def) * (1 + 1e-9))
        advise(
            tree, "solver.step.dt", notes,
            "the step of %.3g ms is too long for surface tension, whose shortest waves stand %.3g ms: drops boil; use "
            "%g substeps or more",
            1e3 * step, 1e3 * step_tension(&def), substeps_for(&def, step_tension(&def)));
    else if (def.step_mode == STEP_FIXED)
        advise_viscous(tree, &def, &friction, notes);
}

static double greatest_of_table(const FieldTable *table)
{
    size_t places = table ? 1 : 0;
    double speed2 = 0;
    for (int k = 0; table && k < 3; k++)
        places *= (size_t)table->count[k];
    for (size_t i = 0; i < places; i++) {
        double sum = 0;
        for (int c = 0; c < FIELD_TABLE_COLUMNS; c++)
            sum += table->value[c] ? table->value[c][i] * table->value[c][i] : 0;
        speed2 = fmax(speed2, sum);
    }
    return sqrt(speed2);
}

static double greatest_start(const WorldDef *def)
{
    double speed = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        const double *v = def->fluids[f].velocity;
        speed = fmax(speed, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + def->fluids[f].taylor_green +
                                greatest_of_table(def->fluids[f].flow_table));
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            speed = fmax(speed, def->fluids[f].emits[i].speed);
    }
    return speed;
}

/* Lowest and highest ends of a fluid's fills along `up`, m. */
static void ends_along(const FluidDef *fluid, const double up[3], double *bottom, double *top)
{
    *bottom = INFINITY;
    *top = -INFINITY;
    for (int i = 0; i < fluid->fill_count; i++) {
        double low[3], high[3], least = 0, most = 0;
        fill_bounds(&fluid->fills[i], low, high);
        for (int k = 0; k < 3; k++) {
            least += fmin(up[k] * low[k], up[k] * high[k]);
            most += fmax(up[k] * low[k], up[k] * high[k]);
        }
        *bottom = fmin(*bottom, least);
        *top = fmax(*top, most);
    }
}

/* Greatest pressure of heavier fluids on a fluid, Pa: of their columns above the fluid's bottom. */
static double borne(const WorldDef *def, int f, const double gravity[3])
{
    const double g = sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    double most = 0, bottom, other_bottom, top;
    if (g == 0)
        return 0;
    const double up[3] = {-gravity[0] / g, -gravity[1] / g, -gravity[2] / g};
    ends_along(&def->fluids[f], up, &bottom, &top);
    for (int k = 0; k < def->fluid_count; k++) {
        ends_along(&def->fluids[k], up, &other_bottom, &top);
        if (def->fluids[k].density > def->fluids[f].density && top > bottom)
            most = fmax(most, def->fluids[k].density * g * (top - bottom));
    }
    return most;
}

void advise_borne(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const double much = 0.1, good = 0.03; /* compressions */
    const WorldDef *def = &scene->world;
    if (method_find(def->method)->incompressible)
        return;
    for (int f = 0; f < def->fluid_count; f++) {
        const double density = def->fluids[f].density, c = def->sound_speed,
                     pressure = borne(def, f, def->gravity),
                     pressed = pow(1 + 7 * pressure / (density * c * c), 1.0 / 7) - 1;
        if (pressed > much)
            advise(
                tree, "solver.sound_speed", notes,
                "fluids[%d], of %g kg/m3, bears up to %.0f Pa of heavier fluid, which press it by %.0f %% at a "
                "sound speed of %g m/s; use %.2g m/s or more",
                f, density, pressure, 100 * pressed, c, sqrt(pressure / (good * density)));
    }
}

/* Cohesion pulls within the fluid too: a low speed of sound loses volume. */
void advise_cohesion(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const double much = 0.03, good = 0.01; /* compressions */
    const WorldDef *def = &scene->world;
    if (method_find(def->method)->incompressible || def->tension_model != TENSION_COHESION)
        return;
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const double c = def->sound_speed, pressure = cohesion_pressure(def, f),
                     pressed = pow(1 + 7 * pressure / (fluid->density * c * c), 1.0 / 7) - 1;
        if (pressed > much)
            advise(
                tree, "solver.sound_speed", notes,
                "%g m/s is little for a surface tension of %g N/m at this spacing: cohesion presses fluids[%d] "
                "by some %.0f %%; use %.2g m/s or more",
                c, fluid->surface_tension, f, 100 * pressed, sqrt(pressure / (good * fluid->density)));
    }
}

double scene_greatest_speed(const WorldDef *def)
{
    const double *a = def->gravity, g = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double start = greatest_start(def);
    return sqrt(start * start + 2 * g * greatest_fall(def));
}

/* The step, or the expected step of mode cfl, s. */
static double step_expected(const WorldDef *def, double speed)
{
    return def->step_mode == STEP_FIXED
               ? def->dt / def->substeps
               : fmin(def->cfl_number * def->support * def->spacing / (step_sound(def) + speed), def->max_dt);
}

/* Positions are in single precision from the box's origin, and move by v dt / 2 at a time: moves of less than
   half the last bit round to nothing. */
void advise_places(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const double much = 0.01; /* as a fraction of the flow's speed */
    const WorldDef *def = &scene->world;
    const double *size = def->box_size, speed = scene_greatest_speed(def), step = step_expected(def, speed);
    const double far = fmax(size[1], 0.5 * fmax(size[0], def->dimensions == 2 ? 0 : size[2]));
    const double bit = far - (double)nextafterf((float)far, 0);
    if (speed > 0 && bit / step > much * speed)
        advise(
            tree, "box.size", notes,
            "%.3g m from the box's origin places are kept to %.2g mm: there, what is slower than %.2g m/s does "
            "not move in steps of %.2g ms; use a smaller box or longer steps",
            far, 1e3 * bit, bit / step, 1e3 * step);
}

void advise_sound(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const double least = 1.75, good = 3; /* c over the speed of the flow: compressed by 18 and 6 % */
    const WorldDef *def = &scene->world;
    const double c = def->sound_speed, speed = scene_greatest_speed(def);
    if (!method_find(def->method)->incompressible && c < least * speed)
        advise(
            tree, "solver.sound_speed", notes,
            "%.3g m/s is little for fluid that may come to %.3g m/s: it is pressed by some %.0f %%; use %.2g "
            "m/s or more%s",
            c, speed, 100 * expm1(0.5 * speed * speed / (c * c)), good * speed,
            def->step_mode == STEP_FIXED ? ", with a step as much shorter" : "");
}
