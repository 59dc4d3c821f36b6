/* libslosh: a world, a fluid in a box; steps, particles, forces, probes, changes. slosh/scene.h has
   the rules for all functions. */
#ifndef SLOSH_WORLD_H
#define SLOSH_WORLD_H

#include "slosh/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct slosh_world slosh_world;

/* ---- make and step ---- */

/* Makes a world at time 0. The scene may be freed afterwards. Worlds compute on the CPU: a scene with a GPU
 * backend is an error. Free with slosh_world_destroy. */
SLOSH_API slosh_world *slosh_world_create(const slosh_scene *scene, slosh_error *error);
SLOSH_API void slosh_world_destroy(slosh_world *world); /* NULL is allowed */

/* From now on `tell` gets the messages, a line each, during calls with the world; first the notes of the
   scene. Messages are of settings without effect, of trouble mended by smaller steps, of emitters that wait,
   and of fluid that clumps or leaks. A NULL `tell`: no messages. */
typedef void slosh_tell(void *user, const char *words);
SLOSH_API void slosh_world_on_message(slosh_world *world, slosh_tell *tell, void *user);

/* Advances by a frame (the scene's dt; with steps of mode cfl, by one step). Returns false if the
   simulation broke: the world then holds the last good state. */
SLOSH_API bool slosh_world_step(slosh_world *world, slosh_error *error);

/* Advances by a single step of a frame. */
SLOSH_API bool slosh_world_substep(slosh_world *world, slosh_error *error);

/* Advances by frames to the first state at or after `time` (s). Mode cfl ends on `time`. */
SLOSH_API bool slosh_world_run(slosh_world *world, double time, slosh_error *error);

/* ---- figures ---- */

SLOSH_API double slosh_world_time(const slosh_world *world);                   /* s */
SLOSH_API uint64_t slosh_world_steps(const slosh_world *world);                /* single steps since time 0 */
SLOSH_API size_t slosh_world_count(const slosh_world *world);                  /* particles */
SLOSH_API int slosh_world_dimensions(const slosh_world *world);                /* 2 or 3 */
SLOSH_API double slosh_world_dt(const slosh_world *world);                     /* of the last step, s */
SLOSH_API double slosh_world_spacing(const slosh_world *world);                /* m */
SLOSH_API double slosh_world_support_radius(const slosh_world *world);         /* m */
SLOSH_API void slosh_world_box_size(const slosh_world *world, double size[3]); /* m */
SLOSH_API void slosh_world_gravity(const slosh_world *world, double g[3]);     /* in the box's frame, m/s2 */

/* The box in the world's frame: position of the origin (m), orientation as a unit quaternion x y z w. */
SLOSH_API void slosh_world_box(const slosh_world *world, double position[3], double orientation[4]);

/* How the run went: "holds", or "clumps at t = 0.3 s: ...". Valid until the next call. */
SLOSH_API const char *slosh_world_outcome(slosh_world *world);

/* A hash of the state: equal states have equal hashes. 0: memory is short. */
SLOSH_API uint64_t slosh_world_hash(slosh_world *world);

/* ---- particles ---- */

enum { SLOSH_FLOAT32 = 1, SLOSH_UINT32 = 2, SLOSH_UINT64 = 3 };

/* A column of numbers, `components` for each of `count` particles. Component k of particle i is at data +
   i stride + k (4 or 8) bytes. */
typedef struct slosh_column {
    size_t size; /* sizeof(slosh_column), set by the caller */
    const void *data;
    size_t count, stride; /* stride in bytes */
    int components;       /* 1, or 3: x y z */
    int type;             /* SLOSH_FLOAT32, ... */
    const char *unit;     /* "m/s"; "": none */
} slosh_column;

/* Name number `index` of the world's columns; NULL after the last. First position, velocity, volume, id (64
   bits) and fluid (index into the scene's fluids). Then scalars: speed, density, pressure, compression
   (density over rest density, minus 1), and columns of the method. */
SLOSH_API const char *slosh_world_column_name(const slosh_world *world, size_t index);

/* Gives the column of the present state, without a copy for each call: the first call after a change of the
   state reads the column, in a single pass over the particles. All columns of a state have a common order;
   the order changes between steps: `id` identifies particles. The values are valid until the world changes;
   the memory is valid until the world is destroyed. Density, pressure and volume are those of the last step's
   middle. */
SLOSH_API bool slosh_world_column(slosh_world *world, const char *name, slosh_column *column,
                                  slosh_error *error);

/* Writes position (m) and velocity (m/s) of all particles; NULL: stays. Each has `count` times three
   float32, `stride` bytes apart (0: 12), in the order of the columns of the present state; afterwards the
   order may differ. Positions must lie in the box, and all numbers be finite; on failure the world is
   unchanged. */
SLOSH_API bool slosh_world_write(slosh_world *world, const float *position, const float *velocity,
                                 size_t count, size_t stride, slosh_error *error);

/* ---- forces and probes ---- */

/* From now on the world sums the forces of the fluid on box and solids. */
SLOSH_API bool slosh_world_watch_forces(slosh_world *world, slosh_error *error);

/* Mean force (N) and torque (N m, about the body's origin) since the last call for the body, in the box's
   frame. The first call also calls slosh_world_watch_forces. `body`: -1 for the box, else the number of a
   solid. Returns the seconds of the mean; 0: no step yet; less than 0 with the reason. */
SLOSH_API double slosh_world_force(slosh_world *world, int body, double force[3], double torque[3],
                                   slosh_error *error);

/* Number of solids. */
SLOSH_API int slosh_world_solid_count(const slosh_world *world);

/* The columns of the scene's probes: count; name, such as "wall.pressure", and unit; NULL: no such column. */
SLOSH_API size_t slosh_world_probe_count(const slosh_world *world);
SLOSH_API const char *slosh_world_probe_name(const slosh_world *world, size_t index);
SLOSH_API const char *slosh_world_probe_unit(const slosh_world *world, size_t index);

/* Reads all probes at the present state; `count` must be slosh_world_probe_count. NaN: no fluid there. Probes
   of forces give the mean since the last reading. */
SLOSH_API bool slosh_world_read_probes(slosh_world *world, double values[], size_t count, slosh_error *error);

/* ---- changes, from the next step on ---- */

/* Sets a live key: "gravity=[0, -3, 0]". A key that is not live is an error. */
SLOSH_API bool slosh_world_set(slosh_world *world, const char *setting, slosh_error *error);

/* Moves the box like a hand: the box follows within the limits of the scene's keys hand.*, and the fluid
   feels the motion. `position`: offset of the box's centre from its home, m; `orientation`: quaternion x y z
   w about the centre, normalised by the library; NULL: upright. */
SLOSH_API bool slosh_world_move_box(slosh_world *world, const double position[3], const double orientation[4],
                                    slosh_error *error);

/* The settings of the world's scene with all changes, as slosh_scene_settings. */
SLOSH_API const char *slosh_world_settings(slosh_world *world);

/* Puts the box there at once; the fluid comes along and feels no force. */
SLOSH_API bool slosh_world_carry_box(slosh_world *world, const double position[3],
                                     const double orientation[4], slosh_error *error);

#ifdef __cplusplus
}
#endif

#endif
