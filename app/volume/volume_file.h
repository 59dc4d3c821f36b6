/* Volume data as files: raw values, and a small YAML header describing the raw file:

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
    double size[3], spacing[3], corner[3]; /* size: counts of values; spacing, corner: m */
    int type, big;                         /* VolumeType; big: true for big endian */
    double scale, offset;
} VolumeHeader;

/* Parses the bytes of a header; pure. Returns false with "path:line:column: problem; advice". */
bool volume_header_parse(const char *path, const char *bytes, size_t size, VolumeHeader *header,
                         Error *error);

/* Fills in the path of the raw file named in the header at `path`: relative to the header, unless it
   begins with '/'. */
void volume_raw_path(const char *path, const VolumeHeader *header, char raw[VOLUME_PATH_SIZE]);

size_t volume_header_bytes(const VolumeHeader *header); /* of the raw file */

/* Converts `count` raw values to floats; pure. */
void volume_values(const VolumeHeader *header, const unsigned char *raw, size_t count, float *value);

/* Reads the header at `path`. Returns false as volume_header_parse, or if the file cannot be read. */
bool volume_header_load(const char *path, VolumeHeader *header, Error *error);

/* Loads a header and its raw file. `volume` is for level_volume; the caller frees *values. Returns false
   if a file is missing, or the raw file is not a regular file or exceeds the machine's memory. Also false
   if the raw file has another length than the header gives, or a value that is not finite. */
bool volume_file_load(const char *path, VolumeData *volume, float **values, Error *error);

#endif
