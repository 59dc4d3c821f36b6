/* libslosh: saved states and recorded runs, files NAME.h5part as the program writes and reads. slosh/scene.h
   has the rules for all functions. */
#ifndef SLOSH_STATE_H
#define SLOSH_STATE_H

#include "slosh/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Saves the present state as a file of a single step; an older file is replaced once the new file is whole.
 */
SLOSH_API bool slosh_world_save(slosh_world *world, const char *path, slosh_error *error);

/* Continues from the last step of a file, also of `slosh run`, with the same bits. The world must be made
   from the same scene with the same settings; the message names the first differing key. On failure the
   world is unchanged. */
SLOSH_API bool slosh_world_load(slosh_world *world, const char *path, slosh_error *error);

/* A file with a step for each call of slosh_record_add. An older file is replaced with the first step. A
   record without a step leaves no file. */
typedef struct slosh_record slosh_record;

SLOSH_API slosh_record *slosh_record_create(slosh_world *world, const char *path, slosh_error *error);

/* Adds the present state of the same world, and syncs the file. */
SLOSH_API bool slosh_record_add(slosh_record *record, slosh_world *world, slosh_error *error);
SLOSH_API void slosh_record_close(slosh_record *record); /* NULL is allowed; before or after the world */

/* A recorded run, opened for reading. */
typedef struct slosh_run slosh_run;

SLOSH_API slosh_run *slosh_run_open(const char *path, slosh_error *error);
SLOSH_API void slosh_run_close(slosh_run *run); /* NULL is allowed */

SLOSH_API size_t slosh_run_count(const slosh_run *run); /* steps, at least 1 */

/* Time of step `index`, s. */
SLOSH_API bool slosh_run_time(slosh_run *run, size_t index, double *time, slosh_error *error);

/* A column of step `index`, by the names of slosh_world_column. Valid until the next call with a different
   step, and until slosh_run_close. The order differs from step to step: `id` identifies particles; a file has
   no more than the low 32 bits here, as SLOSH_UINT32. */
SLOSH_API bool slosh_run_column(slosh_run *run, size_t index, const char *name, slosh_column *column,
                                slosh_error *error);

/* Name number `index` of the columns of the file, NULL after the last. */
SLOSH_API const char *slosh_run_column_name(const slosh_run *run, size_t index);

#ifdef __cplusplus
}
#endif

#endif
