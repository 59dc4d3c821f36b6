/* Commands for a running simulation, and recordings of sessions as lists of commands. */
#ifndef APP_RUN_RECORDING_RECORDING_H
#define APP_RUN_RECORDING_RECORDING_H

#include "app/scene/scene.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reads the bytes of a file line by line: recordings, and the reports of devices. */

enum { LINE_READER_SIZE = 256 }; /* more than any line of numbers */

struct Recording;

typedef struct LineReader {
    const char *path;
    const char *at, *end; /* the unread bytes */
    const char *line;     /* the present line, without its newline */
    size_t length, number;
    struct Recording *out; /* of a recording; else NULL */
    Error *error;
} LineReader;

/* Sets the error "path:line: ..." for the present line and returns false. */
bool line_reader_fail(const LineReader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Error for the present line: "... stands where WANTED must stand"; returns false. */
bool line_reader_misplaced(const LineReader *reader, const char *wanted);

/* Takes the next line. Returns false at the end; an unfinished line without newline was cut and is
   skipped. */
bool line_reader_next(LineReader *reader);

/* True if the next, unread line begins with `with`; true if the present line equals `text`. */
bool line_reader_begins(const LineReader *reader, const char *with);
bool line_reader_is(const LineReader *reader, const char *text);

/* Copies the present line with a final 0; false with a message if longer than any line of numbers. */
bool line_reader_copy(const LineReader *reader, char text[LINE_READER_SIZE]);

/* The present line from `skip` on, joined with its continuation lines ("+ ...") by newlines, as a text that
   the caller frees; NULL with a message if memory is short. */
char *line_reader_text(LineReader *reader, size_t skip);

/* Reads digits at *at, and moves *at after the digits; false if there are none or too many. */
bool line_reader_count(const char **at, uint64_t *count);

/* Commands for a running simulation: of the box, of solids, and all as one type (SimCommand). */

/* The user's changes of the box's size while a simulation runs. */

/* Greatest shrinking of a side at a time, in spacings: a small bite squeezes the fluid less than its own
   waves do. */
#define BOX_SHRINK_MOST 0.04

/* Least length of a side, in spacings. */
#define BOX_SIDE_LEAST 6

/* The user's changes of solids in a running simulation: moves, turns, puts and takes solids. */

typedef enum SolidAction { SOLID_ACTION_MOVE, SOLID_ACTION_PUT, SOLID_ACTION_TAKE } SolidAction;

/* Shape of a put solid: a ball, a box, or SOLID_LIKE + the number of a solid with the same shape. */
enum { SOLID_LIKE_BALL, SOLID_LIKE_BOX, SOLID_LIKE };

typedef struct SolidCommand {
    SolidAction act;
    int solid;    /* of the moved or taken solid; taking a solid decreases all higher numbers by one */
    double at[3]; /* moved: offset from its own motion, m; put: its centre, or above if occupied, box's frame,
                     m */
    double turn[4]; /* moved: unit quaternion around the solid's centre, on top of its own turn */
    int like;       /* put: the shape */
    double size;    /* of a ball or a box: radius, half an edge, m */
    double density; /* put: kg/m3, more than 0: falls and may float; 0: stays */
} SolidCommand;

/* Names move, put, take; and the act of a name, or -1. */
const char *solid_action_name(SolidAction act);
int solid_action_find(const char *name);

/* Commands for a running simulation: the hand, a finger, gates, solids, the size of the box, and changed
   settings. Input, panel and scripts send only such commands, so a list of commands can repeat a session. */

typedef enum SimCommandKind {
    SIM_TARGET, /* world_set_target */
    SIM_CARRY,  /* world_carry_box */
    SIM_TOUCH,  /* world_set_finger */
    SIM_GATES,  /* world_close_gates */
    SIM_SOLID,  /* solid_command_apply */
    SIM_SIZE,   /* box_command_apply */
    SIM_SET,    /* scene_set_live, then world_change, or world_move for a new backend */
    SIM_VALUE   /* scene_set_value, then world_change; SIM_SET in a recording */
} SimCommandKind;

enum { SIM_SETTING_SIZE = SETTING_TEXT_SIZE };

typedef struct SimCommand {
    uint64_t step; /* WorldInfo.step of the application */
    SimCommandKind kind;
    union {
        BoxTarget target;               /* SIM_TARGET, SIM_CARRY */
        Finger finger;                  /* SIM_TOUCH */
        uint64_t closed_gates;          /* SIM_GATES */
        SolidCommand solid;             /* SIM_SOLID */
        double size[3];                 /* SIM_SIZE */
        char setting[SIM_SETTING_SIZE]; /* SIM_SET: "path=value" of a live key */
        SettingValue value;             /* SIM_VALUE: of a key without a new world */
    };
} SimCommand;

/* Of SIM_SET and SIM_VALUE: "path=value", and the path. */
void sim_command_setting(const SimCommand *command, char text[SETTING_TEXT_SIZE]);
void sim_command_path(const SimCommand *command, char path[SETTING_TEXT_SIZE]);

/* True if the command sets the box's pose. */
bool sim_command_poses(const SimCommand *command);

/* Applies the command now, ignoring its step. `scene`: the world's scene, with all later settings; *world is
   replaced if the backend changes. Returns false with the reason, without changes, if the setting is wrong or
   memory is short. */
bool sim_command_apply(const SimCommand *command, World **world, Scene *scene, Error *error);

/* moves: true if the command changes how the world is made: the backend, or data kept for views.
   sets_backend: true for the backend. needs_gpu: true for a backend on a GPU, for which a context must be
   current. */
bool sim_command_moves(const SimCommand *command);
bool sim_command_sets_backend(const SimCommand *command);

/* True if later states may differ after the command; keeping accelerations for display changes no state. */
bool sim_command_changes(const SimCommand *command);
bool sim_command_needs_gpu(const SimCommand *command);

/* A recorded session: the scene, the command line's settings, and each command with its step. The `cpu`
   backend computes the same bits from a recording, with any number of threads.

   The file is text (docs/manual/window.md has an example), for people to read, compare and edit:

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

/* Adds a copy of the command, of a value its text. Non-finite poses and invalid fingers are skipped, as no
   world accepts them. Returns false if memory is short, the count has reached RECORDING_COMMANDS_MAX, the
   step is before the last command's step, or a setting does not end with 0. */
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

/* Command number *next if due at `step` or before, and adds 1 to *next; NULL if it is later, or after the
   last. */
const SimCommand *recording_due(const Recording *recording, size_t *next, uint64_t step);

/* The file's line of the command at `index` (index == count: the end). */
size_t recording_line(const Recording *recording, size_t index);

void recording_destroy(Recording *recording); /* a zeroed recording is allowed */

#endif
