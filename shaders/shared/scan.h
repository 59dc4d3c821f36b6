/* Binding numbers of sim/compute/scan.comp and scan_add.comp, used by solvers and pictures. */
#ifndef SLOSH_SCAN_H
#define SLOSH_SCAN_H

#define SCAN_SIZE_AT 0 /* location of the uniform */

/* Storage buffers, bound by one call */
#define SCAN_VALUES_STORAGE 0
#define SCAN_TOTALS_STORAGE 1

#endif
