/* Names of files in scenes: as long as whole paths. */
#ifndef SLOSH_FILE_NAME_H
#define SLOSH_FILE_NAME_H

enum { FILE_NAME_SIZE = 1024 };

#endif
