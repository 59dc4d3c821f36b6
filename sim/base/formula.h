/* A formula of x, y and z with its derivatives. */
#ifndef SIM_BASE_FORMULA_H
#define SIM_BASE_FORMULA_H

#include "sim/def.h"

/* At a place: value, first derivatives, and second ones by xx, yy, zz, xy, yz, zx. */
typedef struct FormulaJet {
    double value, slope[3], bend[6];
} FormulaJet;

/* `formula`: read with the names "xyz". */
void formula_jet(const Formula *formula, const double place[3], FormulaJet *out);

#endif
