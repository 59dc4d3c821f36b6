/* A recorded session: the scene, the command line's settings, and each command with its step. The `cpu`
   backend computes the same bits from a recording, with any number of threads.

   The file is text (docs/window.md has an example), for people to read, compare and edit:

     slosh recording 1
     program 0.1
     scene scenes/box_slosh.yaml            for people and messages: the text is below
     particles 8192                         --particles, if given
     set solver.sound_speed=12              --set and its short forms, one line each
     text
     | title: ...                           the scene, line by line
     \ no newline at the end                if the text has none
     commands
     0 target 0x1p-3 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x1p+0      step, position, orientation
     40 carry 0x0p+0 ...
     60 touch stir 0x1p-4 0x1p-5 0x0p+0 0x1p-5 0x1.4p+5                way, point, radius (m), strength
     70 touch none
     75 shut fluids[0].emit[0] drains[1]    all gates shut from here on
     80 set gravity=[0, -3, 0]
     end 400 0123456789abcdef               steps, world_hash

   After a newline in a name or setting, the next line begins with "+ ". */
#ifndef APP_RUN_RECORDING_RECORDING_H
#define APP_RUN_RECORDING_RECORDING_H

#include "app/run/recording/sim_command.h"
#include "app/scene/scene.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RECORDING_COMMANDS_MAX = 2000000, RECORDING_BYTES_MAX = 1 << 30 };

/* Owns all pointers. Zero: an empty recording. */
typedef struct Recording {
    char *path;             /* of the scene */
    char *text;             /* the scene file's bytes, without a final 0 */
    size_t size;            /* of the text */
    SceneSettings settings; /* without solver.threads and solver.simd, which change no bit */
    SimCommand *commands;   /* in order of their steps */
    size_t count, capacity; /* of the commands */
    /* only from a file */
    char program[32];    /* version of the writing program */
    bool cut;            /* the end is missing, so the rest is unknown */
    uint64_t steps;      /* count at the end; of a cut recording: at the last command */
    uint64_t hash;       /* world_hash at the end */
    size_t command_line; /* line of the first command; see recording_line */
} Recording;

/* Adds a setting of the session's start; replaces an earlier setting of the same key. Returns false if memory
   is short or there are too many. */
bool recording_set(Recording *recording, const char *setting);

/* Starts a recording with copies of the arguments (settings may be NULL). Returns false with the reason, and
   nothing to destroy, if memory is short or the text contains a byte 0. */
bool recording_create(Recording *recording, const char *path, const char *text, size_t size,
                      const SceneSettings *settings, Error *error);

/* Adds a copy of the command. Non-finite poses and invalid fingers are skipped, as no world accepts them.
   Returns false if memory is short, the count has reached RECORDING_COMMANDS_MAX, the step is before the last
   command's step, or a setting does not end with 0. */
bool recording_add(Recording *recording, const SimCommand *command);

/* Writes the file completely or not at all; `steps` and `hash`: of the world at the end. */
bool recording_write(const Recording *recording, uint64_t steps, uint64_t hash, const char *path,
                     Error *error);

/* Writes a recording with an unknown end: the file has no last line, like a file cut after its commands. */
bool recording_write_cut(const Recording *recording, const char *path, Error *error);

/* Parses the bytes of a file; pure. Returns false with "path:line: the fault; the remedy", and nothing to
   destroy. A recording without its last line is read up to the cut, and gets `cut`. */
bool recording_parse(const char *path, const char *bytes, size_t size, Recording *out, Error *error);
bool recording_read(const char *path, Recording *out, Error *error);

/* True if the file begins like a recording. */
bool recording_is_file(const char *path);

/* The file's line of the command at `index` (index == count: the end). */
size_t recording_line(const Recording *recording, size_t index);

void recording_destroy(Recording *recording); /* a zeroed recording is allowed */

#endif
