/* What happened in a session: the scene, what the command line set in it, and every command with the step at
   which it applied. From this the `cpu` backend computes the same bits again, with any number of threads.

   As a file it is text (docs/window.md shows one), to be read, compared and edited by people:

     slosh recording 1
     program 0.1
     scene scenes/box_slosh.yaml            for people and messages: the text is below
     particles 8192                         --particles, if given
     set solver.sound_speed=12              --set and what stands for it, each
     text
     | title: ...                           the scene, line by line
     \ no newline at the end                if it has none
     commands
     0 target 0x1p-3 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x1p+0      step, position, orientation
     40 carry 0x0p+0 ...
     60 touch stir 0x1p-4 0x1p-5 0x0p+0 0x1p-5 0x1.4p+5                way, point, radius (m), strength
     70 touch none
     75 shut fluids[0].emit[0] drains[1]    all that is shut from here on
     80 set gravity=[0, -3, 0]
     end 400 0123456789abcdef               steps, world_hash

   Where a name or setting has a newline, its next line begins with "+ ". */
#ifndef SLOSH_RECORDING_H
#define SLOSH_RECORDING_H

#include "app/recording/sim_command.h"
#include "app/scene/scene.h"
#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RECORDING_COMMANDS_MAX = 2000000, RECORDING_BYTES_MAX = 1 << 30 };

/* Owns all that it points at. Zero is an empty one. */
typedef struct Recording {
    char *path;             /* of the scene */
    char *text;             /* the scene file's bytes; not ended by a 0 */
    size_t size;            /* of the text */
    SceneSettings settings; /* without solver.threads and solver.simd, which change no bit */
    SimCommand *commands;   /* their steps never go backwards */
    size_t count, capacity; /* of the commands */
    /* what only a file tells */
    char program[32];    /* version that wrote it */
    bool cut;            /* the end is missing: what follows is not known */
    uint64_t steps;      /* done at the end; of a cut one: at the last command */
    uint64_t hash;       /* world_hash then */
    size_t command_line; /* where the first command stands; see recording_line */
} Recording;

/* Adds a setting that the session begins with, in place of an earlier one of the same key. False when memory
   is short or there are too many. */
bool recording_set(Recording *recording, const char *setting);

/* Starts a recording with copies of its arguments (settings may be NULL). False with the reason, and nothing
   to destroy: no memory, or a byte 0 in the text. */
bool recording_create(Recording *recording, const char *path, const char *text, size_t size,
                      const SceneSettings *settings, Error *error);

/* Adds a copy of the command. A pose that is not finite, or what is no finger, is left out, as no world takes
   it. False: no memory, RECORDING_COMMANDS_MAX are there, a step before the last command's, or a setting that
   is not ended by 0. */
bool recording_add(Recording *recording, const SimCommand *command);

/* Writes the file whole or not at all; `steps` and `hash` are those of the world at the end. */
bool recording_write(const Recording *recording, uint64_t steps, uint64_t hash, const char *path,
                     Error *error);

/* The same where the end is not known: the file has no last line, as one that was cut behind its commands. */
bool recording_write_cut(const Recording *recording, const char *path, Error *error);

/* Reads the bytes of a file; pure. False, and nothing to destroy, with "path:line: what is wrong; what would
   be right". A recording that ends before its last line is read as far as it is whole, with `cut`. */
bool recording_parse(const char *path, const char *bytes, size_t size, Recording *out, Error *error);
bool recording_read(const char *path, Recording *out, Error *error);

/* Whether the file begins as a recording does. */
bool recording_is_file(const char *path);

/* The line of the file on which the command at `index` stands (index == count: the end). */
size_t recording_line(const Recording *recording, size_t index);

void recording_destroy(Recording *recording); /* a zeroed one is allowed */

#endif
