#include "sim/step_control.h"

#include "sim/viscosity.h"

#include <math.h>
#include <string.h>

static const double GROWTH = 1.1, FIRST = 0.1;
static const float COMPRESSION_MOST = 5;

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
    if (!watch->bounded)
        return STEP_TROUBLE_SPEED;
    if (sentinel && watch->max_compression > COMPRESSION_MOST)
        return STEP_TROUBLE_DENSITY;
    return watch->lost > watch->lost_limit ? STEP_TROUBLE_LOST : STEP_TROUBLE_NONE;
}

static double greatest_kinematic_viscosity(const WorldDef *def)
{
    double greatest = 0;
    for (int f = 0; f < def->fluid_count; f++)
        greatest = fmax(greatest, def->fluids[f].viscosity / def->fluids[f].density);
    return greatest;
}

double step_cfl(const WorldDef *def, double max_speed, double max_acceleration, double before,
                StepLimit *binding)
{
    const double h = def->support * def->spacing, number = def->cfl_number;
    const double nu = greatest_kinematic_viscosity(def);
    /* The fastest decay on the lattice is 13 to 16 nu / h^2 with mueller's Laplacian; 24, 28 and 36 with
       wcsph's cubic, Wendland and quintic kernel, 39 to 67 in its radial form. Twice its inverse is what a
       step stands. */
    const double form = def->viscosity_form == VISCOSITY_RADIAL ? 16 : 8;
    const double decay = strcmp(def->method, "wcsph") == 0 ? form : 4;
    const double courant = number * h / (def->sound_speed + max_speed);
    const double most[STEP_LIMIT_COUNT] = {
        [STEP_LIMIT_DT] = INFINITY,
        [STEP_LIMIT_COURANT] = courant,
        [STEP_LIMIT_FORCE] = max_acceleration > 0 ? number * sqrt(h / max_acceleration) : INFINITY,
        [STEP_LIMIT_VISCOUS] = nu > 0 ? number * h * h / (decay * nu) : INFINITY,
        [STEP_LIMIT_MAX_DT] = def->max_dt,
        [STEP_LIMIT_GROWTH] = before > 0 ? GROWTH * before : FIRST * courant,
    };
    *binding = STEP_LIMIT_DT;
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        if (most[i] < most[*binding])
            *binding = (StepLimit)i;
    return most[*binding];
}
