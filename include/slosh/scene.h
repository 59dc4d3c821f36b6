/* libslosh, a solver for fluids of particles: scenes. C11 and C++; link with -lslosh.

     slosh_error error;
     slosh_scene *scene = slosh_scene_load("dam_break", NULL, 0, &error);
     slosh_world *world = scene ? slosh_world_create(scene, &error) : NULL;
     while (world && slosh_world_time(world) < 1 && slosh_world_step(world, &error)) ...

   The other headers: slosh/world.h steps a world and reads particles; slosh/state.h saves, resumes and reads
   recorded runs; slosh/mesh.h makes the fluid's surface; slosh/picture.h draws.

   For all functions of the library:
   - Functions that can fail return NULL or false, and write the reason into `error`, which may be NULL.
   - No function prints or ends the process. NULL for a handle is an error or, in a getter, 0.
   - Handles are opaque, and each is freed by the function named beside the handle. A handle is used by a
     single thread at a time; different handles may be used by different threads at the same time. Locks
     inside the library order the reading of scenes and files, and drawing.
   - Text is UTF-8. Units are SI; positions and velocities are in the box's frame, with the origin at the
     centre of the box's floor and y up.
   - Names of scenes, keys, columns and choices are text, so new names need no new version of the library. A
     struct with a member `size` gets sizeof of the struct from the caller, before the call.
   - Meshes of a scene are read in a child process, made by fork: a broken mesh cannot end the caller's
     process. The child ends without running handlers of the caller.
   - Threads of OpenMP wait by spinning, unless OMP_WAIT_POLICY=passive or GOMP_SPINCOUNT is set. */
#ifndef SLOSH_SCENE_H
#define SLOSH_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined __GNUC__
#define SLOSH_API __attribute__((visibility("default")))
#else
#define SLOSH_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* An error in words, without a newline: the fault; the remedy. */
typedef struct slosh_error {
    char message[1024];
} slosh_error;

/* The version of the library in use: "0.1". */
SLOSH_API const char *slosh_version(void);

/* A scene with settings: plain data, the source of worlds. */
typedef struct slosh_scene slosh_scene;

/* Loads a scene. `name`: a file, or the name of a scene of slosh, such as "dam_break". `settings`: `count`
   texts "path=value", as after --set of the program, in the same order; "particles=N" is --particles N. At
   most 64. The settings are not kept. Free with slosh_scene_free. */
SLOSH_API slosh_scene *slosh_scene_load(const char *name, const char *const settings[], size_t count,
                                        slosh_error *error);

/* The same from `size` bytes of YAML. `name` begins the messages, and files named by the scene are found in
 * the folder of `name`: "mine.yaml". */
SLOSH_API slosh_scene *slosh_scene_parse(const char *name, const char *text, size_t size,
                                         const char *const settings[], size_t count, slosh_error *error);

SLOSH_API void slosh_scene_free(slosh_scene *scene); /* NULL is allowed; worlds of the scene stay */

/* Texts are valid until the scene is freed. */
SLOSH_API const char *slosh_scene_title(const slosh_scene *scene);
SLOSH_API const char *slosh_scene_path(const slosh_scene *scene); /* the file as found */

/* Notes of loading: settings without effect, or beyond what a solver can hold. A line each. */
SLOSH_API size_t slosh_scene_note_count(const slosh_scene *scene);
SLOSH_API const char *slosh_scene_note(const slosh_scene *scene, size_t index); /* NULL: no such note */

/* All settings as JSON: {"fluids[0].viscosity": {"value": 0.5, "unit": "Pa s"}, ...}, as `slosh info --json`.
   Valid until the next call. NULL: memory is short. */
SLOSH_API const char *slosh_scene_settings(slosh_scene *scene);

/* Name number `index` of the scenes of slosh; NULL after the last. */
SLOSH_API const char *slosh_scene_name(size_t index);

#ifdef __cplusplus
}
#endif

#endif
