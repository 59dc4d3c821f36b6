#include "app/base/file.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* A short scene, real time on two processors, with a comment on each line. */
static const char text[] =
    "# A block of water falls apart: the smallest scene. `slosh help keys` lists every key.\n"
    "title: My scene                          # the name in the window and in lists\n"
    "box: {size: [0.6, 0.4, 0.3]}             # m: width, height, depth\n"
    "particles: {spacing: 0.02}               # m, from particle to particle: half of it gives eight times as many\n"
    "fluids:                                  # a list: each fluid begins with \"- name\"\n"
    "  - name: water                          # any word\n"
    "    density: 1000                        # kg/m3\n"
    "    viscosity: 0.001                     # Pa s: 0.001 is water, 1 is honey\n"
    "    fill:                                # where the fluid is at the start\n"
    "      - block:                           # other shapes: ball, cylinder\n"
    "          min: [-0.3, 0, -0.15]          # m: the origin is the centre of the box's floor, y is up\n"
    "          max: [-0.1, 0.3, 0.15]         # m: the opposite corner\n"
    "solver:                                  # how the flow is computed\n"
    "  method: pbf                            # `slosh info` lists the methods\n"
    "  step: {dt: 0.0166667, substeps: 1}     # s: the time of a frame, and how many steps it is cut into\n"
    "view:                                    # how the fluid is drawn\n"
    "  color_by: speed                        # or density, pressure, fluid\n";

static bool write_text(const Output *output, Error *error)
{
    FILE *file = fopen(output->temp, "w");
    const bool written = file && fputs(text, file) >= 0;
    if ((file && fclose(file) != 0) || !written)
        return error_set(error, "%.300s: cannot be written (%s)", output->path, strerror(errno));
    return true;
}

/* Writes a new file; an existing file stays. */
static bool write_new(const char *path, Error *error)
{
    Output output = {.temp = ""};
    bool there = false;
    const bool ok = output_begin(&output, path, error) && write_text(&output, error) &&
                    output_commit_new(&output, &there, error);
    output_discard(&output);
    if (there)
        return error_set(error, "%.300s: is there already; name a new file", path);
    return ok;
}

static int run_command(const Args *args)
{
    const char *path = args->scenes[0], *dot = strrchr(path, '.');
    Error error = {{0}};
    if (!dot || strcmp(dot, ".yaml") != 0)
        error_set(&error, "%.300s: the name of a scene ends in .yaml", path);
    else if (write_new(path, &error)) {
        if (!args->quiet)
            fprintf(stderr, "%s: a scene with a comment on each line; change it, and open it by: slosh %s\n",
                    path, path);
        return 0;
    }
    fprintf(stderr, "%s\n", error.message);
    return !dot || strcmp(dot, ".yaml") != 0 ? EXIT_USAGE : EXIT_FAILED;
}

/* clang-format off */
static const OptionRow options[] = {
    ROWS_END
};
/* clang-format on */

const Command command_new = {
    .name = "new",
    .usage = "FILE.yaml [OPTIONS]",
    .help = "writes the smallest scene, with a comment on each line, to begin with",
    .takes = "new scene",
    .takes_min = 1,
    .takes_max = 1,
    .options = options,
    .run = run_command,
};
