/* The cases, each in the file of its name. */
#ifndef SLOSH_CASE_ALL_H
#define SLOSH_CASE_ALL_H

#include "app/case.h"

extern const Case case_hydrostatic, case_hydrostatic_3d; /* case_hydrostatic.c */
extern const Case case_dam_break;                        /* case_dam_break.c */

#endif
