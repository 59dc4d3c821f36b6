/* Rows of options that several commands take: each stands in the tables of these commands, in the order of
   their help. */
#ifndef APP_CLI_OPTION_ROWS_H
#define APP_CLI_OPTION_ROWS_H

#include "app/cli/args/args.h"
#include "app/cli/cli_private.h"
#include "app/scene/scene.h"

#include <stddef.h>

/* Where a value goes: into Args, or into the command's own options. */
#define AT(member)        .offset = offsetof(Args, member)
#define OWN(type, member) .offset = offsetof(type, member), .flags = OPTION_OWN

/* clang-format off */
#define ROW_OUTPUT(WHAT, ...) {"-o", WHAT, OPTION_TEXT, AT(output), __VA_ARGS__}
#define ROW_OUTPUT_FILE       ROW_OUTPUT("OUT", .files = files_replaced, .help = "the file or folder to write")
#define ROW_TIME(DEFAULT, HELP) \
    {"--time", "S", OPTION_NUMBER, AT(time), .initial = (DEFAULT), .max = 1e6, .help = HELP}
#define ROW_SIZE(HELP) {"--size", "WxH", OPTION_SIZE, AT(width), .min = 1, .max = 16384, .help = HELP}
#define ROW_PICTURE_SIZE ROW_SIZE("width and height of the picture in pixels")
#define ROW_FRAMES(TYPE) \
    {"--frames", "N", OPTION_COUNT, OWN(TYPE, frames), .min = 1, .max = 1e7, .help = "number of frames"}

#define ROW_EVERY(TYPE) \
    {"--every", "S", OPTION_NUMBER, .offset = offsetof(TYPE, every), .initial = 1.0 / 30, .max = 1e6, \
     .flags = OPTION_OWN | OPTION_OPEN_LOW, .help = "seconds from snapshot to snapshot (1/30)"}

/* Of commands that simulate a scene. */
#define ROWS_SCENE \
    {"--set", "PATH=VALUE", OPTION_SETTING, AT(settings), \
     .help = "any key of the scene, such as solver.step.dt=0.01; repeat for more"}, \
    {"--particles", "N", OPTION_PARTICLES, AT(settings.particles), .min = 1, .max = 2147483647, \
     .help = "the spacing that gives about N particles"}, \
    {"--backend", "NAME", OPTION_SETTING, AT(settings), .path = "solver.backend", .help = "what computes the fluid"}, \
    {"--method", "NAME", OPTION_SETTING, AT(settings), .path = "solver.method", .help = "the equations of the solver"}
#define ROW_VIEW \
    {"--view", "NAME", OPTION_SETTING, AT(settings), .path = "view.kind", .help = "how the fluid is drawn"}
#define ROW_PRESET \
    {"--preset", "NAME", OPTION_SETTING, AT(settings), .path = "preset", .names = preset_name, \
     .help = "settings that go together, in place of the scene's: of a fluid (NAME:FLUID: of that one of several) or of the solver; --set goes before it"}
#define ROWS_PROCESSOR \
    {"--threads", "N", OPTION_SETTING, AT(settings), .path = "solver.threads", .help = "threads of the CPU; 0: one for each processor"}, \
    {"--simd", "NAME", OPTION_SETTING, AT(settings), .path = "solver.simd", .help = "SIMD instructions of the CPU solver"}
#define ROW_GPU \
    {"--gpu", "N", OPTION_COUNT, AT(gpu), .initial = -1, .max = 15, .help = "which GPU, counted from 0; without it the first, or a software driver"}
#define ROW_SHADERS \
    {"--shaders", "DIR", OPTION_TEXT, AT(shaders), .files = files_read, .pattern = "*.@(vert|frag|geom|comp|glsl)", \
     .help = "read the shaders from there; play reads them again when they change"}

/* Of motion devices. */
#define ROW_DEVICE(HELP) \
    {"--device", "file:PATH", OPTION_DEVICE, AT(device), .files = files_device, .help = HELP}
#define ROW_DEVICE_REFUSED(WHY) {"--device", "file:PATH", OPTION_REFUSED, .help = "refused: " WHY}
#define ROW_MAPPING(...) {"--mapping", "FILE", OPTION_TEXT, AT(mapping), .files = files_read, __VA_ARGS__}
#define MAPPING_HELP \
    .help = "what motion devices do (the user's slosh/mapping.yaml, if there is one, or what is built in)"
#define ROWS_DEVICE_MOVES \
    ROW_DEVICE("a recording of motion devices (slosh devices --record) moves the box, in simulated time"), \
    ROW_MAPPING(.needs = "--device", MAPPING_HELP, \
                .needs_why = "says what motion devices do; add --device file:PATH, or leave it out")

/* At the end of each table. */
#define ROW_JSON \
    {"--json", "FILE", OPTION_TEXT, AT(json), .files = files_json, \
     .help = "also write the figures as JSON into FILE; -: standard output"}
#define ROWS_END \
    {"--quiet", NULL, OPTION_FLAG, AT(quiet), .help = "no progress and no table"}, \
    {"--help", NULL, OPTION_HELP, .help = "this text"}, \
    {0}
/* clang-format on */

#endif
