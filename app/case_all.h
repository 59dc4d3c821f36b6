/* The cases, each in the file of its name. */
#ifndef SLOSH_CASE_ALL_H
#define SLOSH_CASE_ALL_H

#include "app/case.h"

extern const Case case_hydrostatic, case_hydrostatic_3d; /* case_hydrostatic.c */
extern const Case case_dam_break, case_dam_break_2d;     /* case_dam_break.c */
extern const Case case_free_fall;                        /* case_free_fall.c */
extern const Case case_bucket;                           /* case_bucket.c */
extern const Case case_sloshing;                         /* case_sloshing.c */
extern const Case case_wave;                             /* case_wave.c */
extern const Case case_ellipse;                          /* case_ellipse.c */
extern const Case case_collision;                        /* case_collision.c */
extern const Case case_drop, case_laplace;               /* case_tension.c */
extern const Case case_vortices;                         /* case_vortices.c */
extern const Case case_poiseuille, case_couette;         /* case_channel.c */
extern const Case case_cavity, case_cavity_1000;         /* case_cavity.c */

#endif
