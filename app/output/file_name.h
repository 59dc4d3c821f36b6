/* Names for what the window writes into the present folder. */
#ifndef SLOSH_OUTPUT_FILE_NAME_H
#define SLOSH_OUTPUT_FILE_NAME_H

/* slosh-20261121-101500.png, or -2, -3, ... where that is there. */
void file_name_new(char path[1024], const char *extension);

#endif
