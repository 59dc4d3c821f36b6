/* OpenGL for backends and pictures: errors and limits of the driver, saved state, programs from shader
   files, and the clock of GPU stages. All functions need a current OpenGL 4.5 core context. */
#ifndef SIM_GPU_GL_H
#define SIM_GPU_GL_H

#include "sim/base/base.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Errors of the GL driver: counted and printed, so that tests can require zero errors. Messages of the
   shader compiler do not count: program_create returns them to its caller. Lack of memory counts where the
   caller of gl_errors_take has not taken the code. */

/* Call first in a new context. Listens to errors from now on; the driver may call back later, from another
   thread: synchronous messages would keep drivers from working on threads. Lets the driver compile programs
   on as many threads as it has. */
void gl_context_begin(void);

/* Takes pending glGetError codes. Returns the number of codes equal to `code`, or of all codes if `code` is
   0, for the caller to handle. The rest count as errors. */
int gl_errors_take(unsigned code);

/* Errors of all contexts since gl_context_begin, with pending glGetError codes of the current context. */
int gl_debug_errors(void);

/* Errors of all contexts since program start; needs no context. */
int gl_debug_total(void);

/* Calls of the driver, on all threads: one thread at a time may call. A picture or a substep is the
   difference of two looks. */
typedef struct GlCalls {
    uint64_t calls, dispatches, draws, barriers, questions; /* `calls`: all */
    uint64_t waits;                                         /* for the GPU */
    uint64_t readbacks;                                     /* waits that fetch numbers or pixels */
    uint64_t bytes; /* written into buffers by the program, and copied between buffers */
} GlCalls;

/* The calls since the first context. Calls without effect are left out; a barrier waits for the next call
   beyond settings. Without a context of libEGL no call is left out or counted. */
GlCalls gl_calls(void);

/* The calls since the look `before`. */
GlCalls gl_calls_since(const GlCalls *before);

/* For gl_context_begin: the context is unknown. */
void gl_calls_begin(void);

/* The GPU's time in each program, by timestamps around each dispatch and draw. */
typedef struct GlProgramTime {
    char name[64];    /* the program's label */
    unsigned runs;    /* dispatches and draws */
    double ms;        /* of all runs */
    double before_ms; /* since the end of the program before: copies, clears, and waits for the CPU */
} GlProgramTime;

/* Measures from now on, in the current context. Without memory, runs are left out. */
void gl_programs_begin(void);

/* Around each dispatch and draw, for gl_calls.c. */
bool gl_programs_run(void);
void gl_programs_ran(bool measured);

/* Ends the measurement; waits for the GPU. Returns the number of programs in `times`, at most `most`; the
   greatest sums come first. */
size_t gl_programs_end(GlProgramTime *times, size_t most);

/* Driver limits that shaders need beyond the guarantees of OpenGL 4.5, checked at start to avoid silent
   empty pictures. */

/* Limits of a driver, or required limits; 0: the guarantee of OpenGL. */
typedef struct GlLimits {
    int compute_blocks; /* storage blocks in a compute shader */
    int vertex_blocks;  /* storage blocks in a vertex shader */
    int bindings;       /* of storage buffers */
    int64_t block_bytes;
} GlLimits;

typedef struct GlNeeds {
    const char *who, *instead; /* "backend compute"; advice if blocks or bindings are missing */
    GlLimits least;            /* 0: no requirement */
} GlNeeds;

/* Needs a current context. */
GlLimits gl_limits(void);

/* Bytes of GPU memory if reported by the driver, otherwise of the machine's memory. Needs a current
   context. */
double gl_memory(void);

/* True if all needs are met; otherwise the error names the driver's limit. */
bool gl_limits_allow(const GlLimits *have, const GlNeeds *needs, Error *error);

/* GL context state changed by a solver's draw passes: saved before and restored after, since the views draw
   in the same context. Texture units and programs are not included: every pass binds its own. */

enum { GL_STATE_CAPABILITIES = 10 };

/* Zero-initialise. */
typedef struct GlState {
    int depth; /* nesting depth of gl_state_keep */
    int framebuffer, vertex_array, viewport[4];
    int clip_origin, clip_depth, depth_function, polygon_mode[2];
    int stencil[7]; /* function, reference, mask, three operations, write mask; of front faces */
    float depth_range[2], point_size;
    unsigned char depth_mask, color_mask[4];
    unsigned char enabled[GL_STATE_CAPABILITIES];
} GlState;

/* Saves the context's state and sets a plain state: tests, blending, culling and similar features off, all
   masks open, depths from 0 to 1, points of a pixel. Nested calls do not query the state again, since
   asynchronous drivers stall on queries. The outermost gl_state_restore restores the state. */
void gl_state_keep(GlState *kept);
void gl_state_restore(GlState *kept);

/* Backends that need GL. */

struct Backend; /* sim/step/backend.h */

extern const struct Backend backend_compute, backend_fragment;

/* Settings of fragment's grid, whose layers hold four particles per cell. */
typedef struct MAY_ALIAS FragmentDef {
    int grid_layers; /* 0: as many as a lattice needs */
    int lost_limit;  /* most particles without a place in the grid, per step */
} FragmentDef;

/* Layers of fragment's grid for a world of the def. */
int fragment_layers(const WorldDef *def);

/* The settings of backend fragment in a def. */
FragmentDef *fragment_def(const WorldDef *def);

/* Adds the GL backends to the list of sim/step/backend.h; call before any scene is read. */
void backends_add(void);

/* The text of a shader, embedded in the program or read from a folder, with includes expanded.

   A line `#include "common/frame.glsl"` pastes the file, once per shader; paths start at the folder
   shaders/. Headers shared with C have their C paths, "shaders/shared/frame_block.h". A line `#include
   NAME` pastes the file of an earlier line `#define NAME common/frame.glsl`, and nothing without such a
   line. #line marks give the compiler file and line numbers, and shader_source_log turns these numbers back
   into names. The language is GLSL 4.50; for .vert, .geom and .frag below sim/ GLSL 3.30. */

typedef struct EmbeddedShader {
    const char *path, *text;
} EmbeddedShader;

extern const EmbeddedShader embedded_shaders[]; /* ended by a NULL path; made at build time */

enum { SHADER_FILES_MAX = 40, SHADER_PATH_MAX = 128 };

typedef struct ShaderSource {
    char *text; /* owned; complete, with #version and the defines */
    size_t size, capacity;
    int file_count;
    char file[SHADER_FILES_MAX][SHADER_PATH_MAX]; /* indexed by the file number in #line */
} ShaderSource;

/* From now on shaders are read from `directory`; NULL: from the embedded shaders. For all threads; set
   before use. */
void shader_source_set_directory(const char *directory);

/* A number that changes with the files in the directory (by modification times); 0 without a directory. */
uint64_t shader_source_stamp(void);

/* `defines`: lines ("#define A 1\n") before the file, or NULL. Returns false if a file is missing: `error`
   has the name and the including line. */
bool shader_source_load(ShaderSource *source, const char *path, const char *defines, Error *error);
void shader_source_free(ShaderSource *source);

/* True if the file exists, in the program or the directory. */
bool shader_source_has(const char *path);

/* GL programs from shader files. */

/* Compiles and links the files `stages` (paths below shaders/, ended by NULL; .vert .geom .frag or .comp
   gives the stage) after the lines `defines` ("#define A 1\n", or NULL). Returns the GL name, labelled
   `label`; the caller deletes the program with glDeleteProgram. 0 on failure: `error` has "file:line:
   log". */
unsigned program_create(const char *label, const char *const stages[], const char *defines, Error *error);

/* Equal sources are compiled once a process. Each caller has a separate program, with separate uniforms. */

/* program_create with an output for transform feedback. */
unsigned program_create_captured(const char *label, const char *const stages[], const char *defines,
                                 const char *output, Error *error);

/* Between programs_begin and programs_finish, program_create does not wait, so that a driver can compile
   several programs in parallel. programs_finish waits. False: a program does not compile, and the callers
   delete the programs. Pairs may nest; the outermost counts. */
void programs_begin(void);
bool programs_finish(Error *error);

/* program_create in two halves, so that a driver can compile several programs in parallel. program_begin
   does not wait and returns 0 if a file is missing; program_finish is true on success and takes the same
   arguments. */
unsigned program_begin(const char *label, const char *const stages[], const char *defines, Error *error);
bool program_finish(unsigned program, const char *label, const char *const stages[], const char *defines,
                    Error *error);

/* program_create for a vertex and a fragment shader. */
unsigned program_create_pair(const char *label, const char *vertex, const char *fragment, Error *error);

/* For tests of shaders: from now on shaders are read from this folder; NULL: from the shaders embedded in the
   program. */
void program_set_directory(const char *directory);

/* The clock of GPU stages, under the names of sim/world.h.

   `gl`: timestamp queries, read when available (two frames later), without waiting. On a software renderer
   such queries are wrong: work is deferred, and timestamps are taken at recording, not at execution. There,
   `finish` puts glFinish and the CPU clock around each stage, which costs the overlap of CPU and GPU. */

typedef enum GlClock {
    GL_CLOCK_AUTO, /* `finish` on a software renderer, else `gl` */
    GL_CLOCK_OFF,
    GL_CLOCK_QUERY,
    GL_CLOCK_FINISH
} GlClock;

typedef struct GlTimer GlTimer;

/* Returns NULL if memory is short. All functions accept a NULL timer, which measures nothing and costs
   nothing. */
GlTimer *gl_timer_create(GlClock clock);
void gl_timer_destroy(GlTimer *timer);

/* Works a GPU for 0.3 s before a measurement: the clocks of an idle GPU are low, and rise under load. Does
   nothing on a software renderer, or without a timer. */
void gl_timer_warm_up(const GlTimer *timer);

/* "gl", "finish" or "off": the actual clock. */
const char *gl_timer_clock_name(const GlTimer *timer);

/* Calls `between` after each stage, with any clock: for other work during a long picture. `between` must
   not call OpenGL. */
void gl_timer_between(GlTimer *timer, void (*between)(void *user), void *user);

/* Stages do not nest; several runs in a frame are summed. */
void gl_timer_begin(GlTimer *timer);
void gl_timer_end(GlTimer *timer, Stage stage);

/* Ends the frame. True if the times of a frame are known: of this frame (`finish`) or of an earlier frame
   (`gl`). Frames come in order, none is lost. Writes GL stages only; the rest of `times` is unchanged. */
bool gl_timer_frame(GlTimer *timer, StageTimes *times);

/* Waits for a frame that gl_timer_frame still owes, a frame per call; false if there is none. */
bool gl_timer_drain(GlTimer *timer, StageTimes *times);

/* A clock for GPU solver stages that writes to the timer. */
StageClock gl_timer_stage_clock(GlTimer *timer);

/* True for llvmpipe, softpipe and swrast, by the renderer's name. */
bool gl_renderer_is_software(void);

/* GL_STAGE(timer, STAGE_SHADE) statement; */
#define GL_STAGE(timer, stage)                                                                               \
    for (int gl_stage_once = (gl_timer_begin(timer), 1); gl_stage_once;                                      \
         gl_stage_once = (gl_timer_end(timer, stage), 0))

#endif
