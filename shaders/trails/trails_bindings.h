/* Binding numbers used only by the shaders of trails; more in shaders/shared/bindings.h. */
#ifndef SLOSH_TRAILS_BINDINGS_H
#define SLOSH_TRAILS_BINDINGS_H

/* Storage buffers */
#define TRAIL_IDS_STORAGE    3
#define TRAIL_PLACES_STORAGE 4
#define TRAIL_OWNERS_STORAGE 5
#define TRAIL_SEEN_STORAGE   6
#define TRAIL_CLAIMS_STORAGE 7
#define TRAIL_BLOCKS_STORAGE 4 /* for a picture drawn by the CPU */

/* Texture units */
#define TRAIL_LINES_UNIT 1

/* Locations of uniforms */
#define TRAIL_COUNT_AT     16 /* particles */
#define TRAIL_ID_STRIDE_AT 17
#define TRAIL_EVERY_AT     18 /* ids */
#define TRAIL_SLOTS_AT     19
#define TRAIL_COLUMN_AT    20
#define TRAIL_BEFORE_AT    21 /* the previous column */
#define TRAIL_EARLIER_AT   22 /* the column before the previous */
#define TRAIL_CLAIMS_AT    23
#define TRAIL_LEAST_AT     24 /* corner of the region */
#define TRAIL_GREATEST_AT  25
#define TRAIL_PLANE_AT     26
#define TRAIL_IS_FLUID_AT  27
#define TRAIL_WRAP_AT      28
#define TRAIL_TIME_AT      29
#define TRAIL_FADE_AT      30
#define TRAIL_TIMES_AT     31 /* times of the previous and the present column */
#define TRAIL_KNOWN_AT     32
#define TRAIL_LISTED_AT    33
#define TRAIL_LIST_AT      40 /* to 55 */

#define TRAIL_NO_COLUMN  0xffffffffu
#define TRAIL_LISTED_IDS 16
#define TRAIL_TILE_SIDE  16 /* pixels; */
#define TRAIL_BLOCK_SIDE 64 /* whole tiles */

#endif
