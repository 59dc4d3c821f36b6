#include "app/cmd.h"
#include "app/export.h"
#include "app/headless.h"
#include "app/metric_list.h"
#include "app/scene_keys.h"
#include "app/scene_preset.h"
#include "render/view.h"
#include "sim/kernel.h"
#include "sim/tension.h"
#include "sim/viscosity.h"
#include "sim/world.h"

#include <stdio.h>

static void print_row(const char *name, const char *help)
{
    printf("  %-12s %s\n", name, help);
}

static void print_named(const char *title, const Named *list)
{
    printf("%s\n", title);
    for (; list->name; list++)
        print_row(list->name, list->help);
}

/* A world of the scene, or a small one, shows whether a backend on a GPU can do it; `no_context`: why there
   is none, or NULL. */
static void print_backend(const Named *backend, const WorldDef *scene, const char *no_context)
{
    WorldDef def = *scene;
    Error error = {{0}};
    print_row(backend->name, backend->help);
    snprintf(def.backend, sizeof def.backend, "%s", backend->name);
    if (!world_on_gpu(&def))
        return;
    World *world = no_context ? NULL : world_create(&def, &error);
    if (!world)
        printf("  %-12s cannot run here: %s\n", "", no_context ? no_context : error.message);
    world_destroy(world);
}

/* A block of fluid in a box. */
static WorldDef small_def(void)
{
    WorldDef def = world_def_default();
    for (int k = 0; k < 3; k++)
        def.box_size[k] = 1;
    def.spacing = 0.1;
    def.fluid_count = 1;
    def.fluids[0] = (FluidDef){.density = 1000, .fill_count = 1};
    def.fluids[0].fills[0] = (Fill){.kind = FILL_BLOCK, .min = {-0.5, 0, -0.5}, .max = {0.5, 0.5, 0.5}};
    return def;
}

static void print_backends(const WorldDef *scene, int gpu)
{
    Error error = {{0}};
    const WorldDef small = small_def();
    Headless *context = headless_create(gpu, &error);
    printf("renderer\n  %s\n", context ? headless_renderer(context) : error.message);
    printf("backends\n");
    for (const Named *backend = world_backends(); backend->name; backend++)
        print_backend(backend, scene ? scene : &small, context ? NULL : error.message);
    headless_destroy(context);
}

static void print_lists(void)
{
    print_named("methods", world_methods());
    printf("presets\n");
    for (const Preset *preset = preset_list; preset->name; preset++)
        print_row(preset->name, preset->help);
    printf("density kernels\n");
    for (const Kernel *kernel = density_kernels; kernel->name; kernel++)
        print_row(kernel->name, kernel->help);
    printf("kernels of wcsph\n");
    for (const Kernel *kernel = wcsph_kernels; kernel->name; kernel++)
        print_row(kernel->name, kernel->help);
    printf("models of surface tension\n");
    for (const TensionKind *kind = tension_kinds; kind->name; kind++)
        print_row(kind->name, kind->help);
    printf("forms of viscosity of wcsph\n");
    for (const ViscosityKind *kind = viscosity_kinds; kind->name; kind++)
        print_row(kind->name, kind->help);
    printf("views\n");
    for (const ViewKind *const *view = view_list; *view; view++)
        print_row((*view)->name, (*view)->help);
    print_row("none", "draws nothing; for timing the solver alone");
    printf("scalars\n");
    for (int s = 0; s < SCALAR_COUNT; s++)
        print_row(scalar_name((Scalar)s), scalar_unit((Scalar)s));
    print_named("exports", export_kinds());
    printf("metrics of a scene, which chart compares\n");
    for (const MetricKind *metric = metric_kinds; metric->name; metric++)
        printf("  %-17s %s%s%s%s\n", metric->name, metric->help, *metric->unit ? " (" : "", metric->unit,
               *metric->unit ? ")" : "");
    printf("motions of the box\n");
    for (int m = 0; m < MOTION_KIND_COUNT; m++)
        print_row(motion_name((MotionKind)m), motion_help((MotionKind)m));
}

int cmd_info(const Args *args)
{
    Error error = {{0}};
    Notes notes;
    SceneSettings settings = args->settings;
    Scene scene;
    if (args->scene_count && !scene_load(args->scenes[0], &settings, &scene, &notes, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    print_backends(args->scene_count ? &scene.world : NULL, args->gpu);
    print_lists();
    printf("threads\n  %d\n", world_processors());
    if (!args->scene_count)
        return 0;
    const size_t count = world_def_count(&scene.world, scene.world.spacing);
    printf("%s: %zu particle%s\n", scene.path, count, plural(count));
    notes_print(&notes, stderr);
    preset_print(&scene, stdout);
    scene_print(&scene, stdout);
    return 0;
}
