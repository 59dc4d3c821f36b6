/* Names of the files that a scene names: as long as paths are that are put together. */
#ifndef SLOSH_FILE_NAME_H
#define SLOSH_FILE_NAME_H

enum { FILE_NAME_SIZE = 1024 };

#endif
