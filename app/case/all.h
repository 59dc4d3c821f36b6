/* The cases, each in the file of its name. */
#ifndef SLOSH_CASE_ALL_H
#define SLOSH_CASE_ALL_H

#include "app/case/case.h"

extern const Case case_hydrostatic, case_hydrostatic_3d; /* hydrostatic.c */
extern const Case case_dam_break, case_dam_break_2d;     /* case_dam_break.c */
extern const Case case_free_fall;                        /* case_free_fall.c */
extern const Case case_bucket;                           /* bucket.c */
extern const Case case_sloshing;                         /* sloshing.c */
extern const Case case_wave;                             /* wave.c */
extern const Case case_ellipse;                          /* ellipse.c */
extern const Case case_collision;                        /* collision.c */
extern const Case case_drop, case_laplace;               /* tension.c */
extern const Case case_vortices;                         /* vortices.c */
extern const Case case_poiseuille, case_couette;         /* channel.c */
extern const Case case_cavity, case_cavity_1000;         /* cavity.c */

#endif
