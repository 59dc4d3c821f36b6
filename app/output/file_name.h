/* Names for files that the window writes into the present folder. */
#ifndef SLOSH_OUTPUT_FILE_NAME_H
#define SLOSH_OUTPUT_FILE_NAME_H

/* New name such as slosh-20261121-101500.png, or with -2, -3, ... if the name is taken. */
void file_name_new(char path[1024], const char *extension);

#endif
