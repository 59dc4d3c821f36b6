/* The numbers by which C hands to the shaders of render/probe what only they read; those of
   shaders/shared/bindings.h besides. */
#ifndef SLOSH_PROBE_BINDINGS_H
#define SLOSH_PROBE_BINDINGS_H

/* Storage buffers */
#define PROBE_IDS_STORAGE     4
#define PROBE_PARTS_STORAGE   5
#define PROBE_ANSWERS_STORAGE 6

/* Texture units */
#define PROBE_DEPTH_UNIT 1

/* Locations of uniforms */
#define PROBE_COUNT_AT     16
#define PROBE_PARTICLES_AT 17
#define PROBE_REACH_AT     18
#define PROBE_GROUPS_AT    19
#define PROBE_ID_STRIDE_AT 20
#define PROBE_ASKED_AT     24 /* so many places: */
#define PROBES_MAX         16

/* Particles that one lane of probe_sum.comp looks at, 64 lanes in a group. */
#define PROBE_LANE 32

#endif
