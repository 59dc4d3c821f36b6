#ifndef SLOSH_RENDER_FILE_H
#define SLOSH_RENDER_FILE_H

#include "app/session/args.h"

/* `slosh render FILE.h5part`: pictures of a recorded run. Returns the exit code. */
int render_file(const Args *args);

/* `slosh render` of a recorded session, which is simulated again: render_session.c. Returns the exit code. */
int render_session(const Args *args);

#endif
