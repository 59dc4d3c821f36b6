/* Volume data as files: raw values, and a small YAML header beside them that says what they are:

     file: engine.raw             # beside the header
     size: [256, 256, 128]        # values along x, y, z; x runs fastest
     type: uint8                  # uint8, int8, uint16, int16, float32
     byte_order: little           # or big; little by default
     spacing: [0.001, 0.001, 0.002]   # m, between values
     corner: [-0.128, 0, -0.128]  # m, the box's frame: of the first value; 0 by default
     scale: 0.0039216             # a value is offset + scale raw; 1 and 0 by default
     offset: 0
*/
#ifndef SLOSH_VOLUME_FILE_H
#define SLOSH_VOLUME_FILE_H

#include "sim/base/error.h"
#include "sim/surface/volume_field.h"

#include <stddef.h>

enum { VOLUME_NAME_SIZE = 512, VOLUME_PATH_SIZE = 2048 };

typedef enum VolumeType { VOLUME_UINT8, VOLUME_INT8, VOLUME_UINT16, VOLUME_INT16, VOLUME_FLOAT32 } VolumeType;

typedef struct VolumeHeader {
    char file[VOLUME_NAME_SIZE];
    double size[3], spacing[3], corner[3]; /* values; m */
    int type, big;                         /* VolumeType; whether the greatest byte comes first */
    double scale, offset;
} VolumeHeader;

/* Reads the bytes of a header; pure. False with "path:line:column: what is wrong; what would be right". */
bool volume_header_parse(const char *path, const char *bytes, size_t size, VolumeHeader *header,
                         Error *error);

/* The path of the raw file that the header at `path` names: beside it, unless the name begins with '/'. */
void volume_raw_path(const char *path, const VolumeHeader *header, char raw[VOLUME_PATH_SIZE]);

size_t volume_header_bytes(const VolumeHeader *header); /* of the raw file */

/* So many of its raw values as floats; pure. */
void volume_values(const VolumeHeader *header, const unsigned char *raw, size_t count, float *value);

/* Reads the header of that path. False as volume_header_parse, or when it cannot be read. */
bool volume_header_load(const char *path, VolumeHeader *header, Error *error);

/* A header and its raw file. `volume` is what level_volume takes; its values belong to the caller, who frees
   them. False when one of the files is not there, or the raw one is no regular file, is shorter or longer
   than the header says, has a value that is no finite number, or more values than this machine has memory
   for. */
bool volume_file_load(const char *path, VolumeData *volume, float **values, Error *error);

#endif
