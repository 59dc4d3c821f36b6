#include "app/scene/lists.h"

#include "app/metric/metric_list.h"

#include "app/scene/keys.h"
#include "app/scene/preset.h"
#include "render/frame/colormap.h"
#include "render/frame/view.h"
#include "render/renderer.h"
#include "sim/kernel/kernel.h"
#include "sim/matter/tension.h"
#include "sim/matter/viscosity.h"
#include "sim/world/world.h"

#include <math.h>
#include <stdio.h>

static const char *named(const Named *list, int index)
{
    for (int i = 0; i < index && list->name; i++)
        list++;
    return list->name;
}

const char *preset_choice(int index)
{
    const Preset *preset = preset_list;
    for (int i = 0; i < index && preset->name; i++)
        preset++;
    return preset->name;
}

const char *method_choice(int index)
{
    return named(world_methods(), index);
}

const char *tension_choice(int index)
{
    return index <= TENSION_COHESION ? tension_kinds[index].name : NULL;
}

const char *backend_choice(int index)
{
    return named(world_backends(), index);
}

const char *view_choice(int index)
{
    int views = 0;
    while (view_at(views))
        views++;
    return index < views ? view_at(index)->name : index == views ? "none" : NULL;
}

const char *colormap_choice(int index)
{
    for (int i = 0; i < index; i++)
        if (!colormap_list[i])
            return NULL;
    return colormap_list[index];
}

const char *scalar_choice(int index)
{
    return index < SCALAR_COUNT ? scalar_name((Scalar)index) : NULL;
}

const char *step_mode_choice(int index)
{
    static const char *const modes[] = {[STEP_FIXED] = "fixed", [STEP_CFL] = "cfl"};
    return index <= STEP_CFL ? modes[index] : NULL;
}

const char *slip_choice(int index)
{
    static const char *const slips[] = {[SLIP_FREE] = "free", [SLIP_NONE] = "none"};
    return index <= SLIP_NONE ? slips[index] : NULL;
}

double srgb_to_linear(double value)
{
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4); /* IEC 61966-2-1 */
}

double linear_to_srgb(double value)
{
    return value <= 0.0031308 ? value * 12.92 : 1.055 * pow(value, 1 / 2.4) - 0.055;
}

void fluid_init(void *element, int index)
{
    /* Told apart by people with any colour vision: Okabe and Ito, "Color universal design", 2008. */
    static const double palette[][3] = {{0.00, 0.45, 0.70}, {0.90, 0.62, 0.00}, {0.00, 0.62, 0.45},
                                        {0.80, 0.47, 0.65}, {0.34, 0.71, 0.91}, {0.84, 0.37, 0.00},
                                        {0.94, 0.89, 0.26}, {0.30, 0.30, 0.30}};
    FluidDef *fluid = element;
    snprintf(fluid->name, sizeof fluid->name, "fluid %d", index + 1);
    fluid->density = 1000; /* water */
    for (int k = 0; k < 3; k++)
        fluid->color[k] = (float)srgb_to_linear(palette[index % 8][k]);
}

void fill_init(void *element, int index)
{
    (void)index;
    ((Fill *)element)->axis[1] = 1;
}

void solid_init(void *element, int index)
{
    (void)index;
    SolidDef *solid = element;
    solid->axis[1] = 1;
    for (int k = 0; k < 3; k++)
        solid->color[k] = (float)srgb_to_linear(0.62); /* a grey that no fluid has */
}

void scene_default(Scene *scene)
{
    *scene = (Scene){.world = world_def_default(), .view = view_def_default(), .realtime = true};
    snprintf(scene->preset, sizeof scene->preset, "%s", preset_list[0].name);
    scene->metric_count = metric_defaults(scene->metrics);
}
