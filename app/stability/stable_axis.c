#include "app/stability/stable_axis.h"

#include "app/base/program.h"
#include "app/scene/keys.h"
#include "app/stability/stable_limits.h"
#include "sim/matter/viscosity.h"
#include "sim/world/method.h"
#include "sim/world/step_control.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 8 };

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* Fills in the points between both ends, with their texts as in a scene file; whole numbers appear once. */
static void fill(StableAxis *axis, double from, double to, int points)
{
    axis->logarithmic = from > 0 && to >= 10 * from;
    axis->count = 0;
    for (int i = 0; i < points; i++) {
        const double part = points > 1 ? (double)i / (points - 1) : 0;
        const double value = axis->logarithmic ? from * pow(to / from, part) : from + part * (to - from);
        char *text = axis->text[axis->count];
        if (axis->row->type == KEY_INTEGER)
            snprintf(text, STABLE_VALUE, "%.0f", value);
        else
            snprintf(text, STABLE_VALUE, "%.5g", value);
        if (axis->count > 0 && strcmp(text, axis->text[axis->count - 1]) == 0)
            continue;
        axis->value[axis->count++] = strtod(text, NULL);
    }
}

static bool unknown(const char *name, Error *error)
{
    int count;
    const Key *keys = scene_keys(&count);
    Suggestion near = suggest_for(name);
    for (int i = 0; i < count; i++)
        suggest_offer(&near, keys[i].path);
    if (near.best)
        return error_set(error, "slosh stability: --axis %.60s: no such key; did you mean '%s'?", name,
                         near.best);
    return error_set(error, "slosh stability: --axis %.60s: no such key; `slosh help keys` lists them", name);
}

/* Returns true if the key can be an axis. */
static bool check_key(const Key *key, const char *name, Error *error)
{
    if (!key)
        return unknown(name, error);
    if (key->type != KEY_NUMBER && key->type != KEY_INTEGER && key->type != KEY_CURVE)
        return error_set(error, "slosh stability: --axis %.60s: is no number; name a key that is one", name);
    if (begins(key->path, "solver.step."))
        return error_set(
            error, "slosh stability: --axis %.60s: the step is what is searched; name another key", name);
    if (key->flags & KEY_IDLE || begins(key->path, "view.") || begins(key->path, "hand."))
        return error_set(
            error, "slosh stability: --axis %.60s changes nothing that is simulated; name another key", name);
    return true;
}

static bool parse_number(const char **text, double *number)
{
    char *end;
    *number = strtod(*text, &end);
    if (end == *text || !isfinite(*number))
        return false;
    *text = end;
    return true;
}

static bool parse_range(const char *text, double *from, double *to, double *points)
{
    if (!parse_number(&text, from) || *text++ != ':' || !parse_number(&text, to))
        return false;
    if (*text == ':') {
        text++;
        if (!parse_number(&text, points))
            return false;
    }
    return !*text;
}

bool stable_axis_parse(const char *text, StableAxis *axis, Error *error)
{
    const char *equals = strchr(text, '=');
    double from, to, points = POINTS;
    if (!equals || equals == text || equals - text >= STABLE_KEY)
        return error_set(error,
                         "slosh stability: --axis takes KEY=a:b such as solver.sound_speed=5:50, not '%.60s'",
                         text);
    snprintf(axis->key, sizeof axis->key, "%.*s", (int)(equals - text), text);
    axis->row = scene_key_find(axis->key);
    if (!check_key(axis->row, axis->key, error))
        return false;
    if (!parse_range(equals + 1, &from, &to, &points))
        return error_set(
            error,
            "slosh stability: --axis %.60s takes two numbers a:b, and how many points, a:b:n, not "
            "'%.60s'",
            axis->key, equals + 1);
    if (!(from < to))
        return error_set(error, "slosh stability: --axis %.60s: %g is not less than %g; write it as %g:%g",
                         axis->key, from, to, to, from);
    if (!(points >= 2 && points <= STABLE_POINTS && points == floor(points)))
        return error_set(error, "slosh stability: --axis %.60s takes 2 to %d points, not %g", axis->key,
                         STABLE_POINTS, points);
    fill(axis, from, to, (int)points);
    return axis->count > 1 ||
           error_set(error, "slosh stability: --axis %.60s: %g and %g are one value", axis->key, from, to);
}

static void choose(StableAxis *axis, const char *key, double from, double to)
{
    snprintf(axis->key, sizeof axis->key, "%s", key);
    axis->row = scene_key_find(key);
    fill(axis, from, to, POINTS);
}

static double rounded(double number)
{
    char text[32];
    snprintf(text, sizeof text, "%.1g", number);
    return strtod(text, NULL);
}

/* Returns the first method with sound, or the first method. */
static const char *leading(const char *const methods[], int count)
{
    int m = 0;
    while (m < count && method_find(methods[m])->incompressible)
        m++;
    return methods[m < count ? m : 0];
}

int stable_axes_choose(const Scene *scene, const char *const methods[], int count,
                       StableAxis axes[STABLE_AXES])
{
    static const double QUARTER = 4, LEAST = 0.01;
    WorldDef def = scene->world;
    StableLimits limits;
    int used = 0;
    snprintf(def.method, sizeof def.method, "%s", leading(methods, count));
    def.viscosity_solver = VISCOSITY_EXPLICIT;
    for (int f = 0; f < def.fluid_count; f++) { /* search from zero viscosity */
        def.fluids[f].viscosity = 0;
        def.fluids[f].viscosity_table.rows = 0;
    }
    stable_limits(&def, &limits);
    const double step = stable_guess(&def, &limits), rate = step_friction(&def).laminar;
    const double most =
        rate > 0 && def.fluid_count > 0 ? rounded(def.fluids[0].density * 2 * QUARTER / (rate * step)) : 0;
    if (step_sound(&def) > 0)
        choose(&axes[used++], "solver.sound_speed", def.sound_speed / QUARTER, QUARTER * def.sound_speed);
    if (most > 0)
        choose(&axes[used++], "fluids[0].viscosity", LEAST * most, most);
    if (used == 0)
        choose(&axes[used++], "particles.spacing", def.spacing, 2 * def.spacing);
    return used;
}
