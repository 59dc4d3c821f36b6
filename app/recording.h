/* A session: a scene, and the commands that it was given, each with its step. On the cpu backend a replay
   gives the same bits.

   As a file it is text that people can read and edit:
     slosh recording 1
     program 0.1
     scene /home/me/box_slosh.yaml
     set solver.step.dt=0.01              one line each, of the command line
     particles 4000                       if --particles was given
     | title: Sloshing in a tank          the scene file, line by line ("\ " before a last line without an
   end) 30 target X Y Z QX QY QZ QW          the step; numbers as hexadecimal floats, exact 96 set gravity=[0,
   -3, 0] end 3000 0x13254aad524a1d69          steps in all; world_hash after them */
#ifndef SLOSH_RECORDING_H
#define SLOSH_RECORDING_H

#include "app/scene.h"
#include "app/sim_command.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RECORDING_COMMANDS_MAX = 1 << 20, RECORDING_BYTES_MAX = 1 << 28 };

typedef struct Recording {
    char path[1024];  /* of the scene, for people: its text is here */
    char program[32]; /* version that wrote the file; "" before */
    char *text;       /* the scene's file; owned, as all below */
    size_t size;
    SceneSettings settings; /* of the command line */
    SimCommand *commands;   /* steps do not fall */
    size_t count, capacity;
    bool complete; /* as read: the end is there, and these two with it */
    uint64_t steps, hash;
} Recording;

/* An empty session of that scene file; all is copied. */
bool recording_create(Recording *recording, const char *path, const char *text, size_t size,
                      const SceneSettings *settings, Error *error);
void recording_destroy(Recording *recording); /* a zeroed one is allowed */

/* False without memory, or at RECORDING_COMMANDS_MAX. */
bool recording_add(Recording *recording, const SimCommand *command);

/* Writes the file whole or not at all (app/output.h). */
bool recording_write(const Recording *recording, uint64_t steps, uint64_t hash, const char *path,
                     Error *error);

/* Reads a file, or its bytes; the scene in it is not looked at. A file that stops short is taken with
   `complete` false. False with "path:line: what is wrong; what would be right"; then `out` is empty. */
bool recording_read(const char *path, Recording *out, Error *error);
bool recording_parse(const char *path, const char *bytes, size_t size, Recording *out, Error *error);

#endif
