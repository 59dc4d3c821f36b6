/* Shared by files of the library: the handles and the lock. Public are the headers of
   include/slosh. */
#ifndef LIBRARY_LIBRARY_H
#define LIBRARY_LIBRARY_H

#include "app/run/run.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "slosh/world.h"

#include <stdbool.h>
#include <stddef.h>

/* Lists of the program, HDF5 and the cache of OpenGL's state belong to the process: the lock orders the
   use by all threads. Not recursive. The first call also prepares the process. */
void library_lock(void);
void library_unlock(void);

/* Copies an error; `to` may be NULL. Returns false. */
bool library_fail(slosh_error *to, const Error *from);

/* Fails with a message. */
bool library_refuse(slosh_error *to, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The scene's settings as JSON; the caller frees the text. NULL: memory is short. */
char *library_settings(const Scene *scene);

struct slosh_scene {
    Scene scene;
    Notes notes;
    char *settings; /* of the last slosh_scene_settings */
};

enum { LIBRARY_COLUMNS = SCALAR_STATE_COUNT + 5 };

/* The buffer of a column. A larger buffer replaces a full one; older buffers stay until the end. */
typedef struct LibraryBuffer {
    void *data;
    size_t bytes;
    uint64_t state; /* slosh_world.state of the values; 0: none */
    struct LibraryBuffer *older;
} LibraryBuffer;

struct slosh_world {
    Run run;
    Notes notes; /* not told yet */
    slosh_tell *tell;
    void *user;
    uint64_t state; /* counts the states: a column is of the present state, or old */
    LibraryBuffer columns[LIBRARY_COLUMNS];
    bool watches_forces;
    Forces of_body[SOLIDS_MAX + 1], of_probes; /* summed since their last readings; body 0 is the box */
    char outcome[OUTCOME_TEXT];
    char *settings;
};

/* Marks the state as changed: after each step, write and load. */
void library_changed(slosh_world *world);

/* Frees the columns. */
void library_columns_free(slosh_world *world);

/* Positions (4 a particle: x y z, volume) of the present state; NULL if memory is short. */
const float *library_positions(slosh_world *world);

#endif
