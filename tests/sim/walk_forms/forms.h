/* What the forms are made of: each part works on all particles of a cloud. All need AVX2. */
#ifndef SLOSH_TEST_FORMS_H
#define SLOSH_TEST_FORMS_H

#include "cloud.h"

typedef void Walk(Cloud *cloud);

/* rows.c: all in the cells around a particle are tested in each pass. */
Walk rows_density, rows_force;

/* making.c: lists of each particle, from all in the cells around it; from a block of a cell's candidates, cut
   to the box around its particles; of those behind it alone; the second, turned to stand side by side. */
Walk lists_of_rows, lists_of_blocks, half_lists, turned_lists;

/* listed.c: eight neighbours of one particle at a time, by gathers from eight columns or from packed ones. */
Walk gathered_density, gathered_force, packed_density, packed_force;

/* once.c: the same with half lists; what a pair does to the other one is added to it at once. */
Walk once_density, once_force;

/* program.c: the program's own loops. */
Walk program_lists, program_density, program_force;

#endif
