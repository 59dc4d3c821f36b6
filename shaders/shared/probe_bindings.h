/* Binding numbers used only by the shaders of render/probe; more in shaders/shared/bindings.h. */
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
#define PROBE_ASKED_AT     24 /* PROBES_MAX locations */
#define PROBES_MAX         16

/* Particles per lane of probe_sum.comp; a group has 64 lanes. */
#define PROBE_LANE 32

#endif
