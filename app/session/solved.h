/* Step limits and figures of iterative solvers over a run (WorldInfo.limited and solved), for JSON and for
   people: the only place with these names. */
#ifndef SLOSH_SOLVED_H
#define SLOSH_SOLVED_H

#include "sim/world/reading.h"

#include <jansson.h>

/* Adds iterations_mean, iterations_p95, density_error_mean and density_error_max to an object, and with
   implicit viscosity viscosity_iterations_mean and viscosity_residual_mean. Adds nothing for a world without
   such solvers. */
void solved_json(json_t *object, const SolveFigures *solved);

enum { SOLVED_WORDS = 192 };

/* "8.3 iterations a step (p95 14), density error 0.048 % mean, 1.2 % max"; "" for other methods. */
const char *solved_text(const SolveFigures *solved, char words[SOLVED_WORDS]);

/* {"courant": 120, "growth": 10}: count of steps for each limit with any. */
json_t *limits_json(const uint64_t limited[STEP_LIMIT_COUNT]);

enum { LIMITS_WORDS = 192 };

/* "courant 92.3 % growth 7.7 %". */
const char *limits_text(const uint64_t limited[STEP_LIMIT_COUNT], char words[LIMITS_WORDS]);

#endif
