/* What a session in the window was: as JSON, and for people. */
#ifndef SLOSH_PLAY_REPORT_H
#define SLOSH_PLAY_REPORT_H

#include "app/play/play.h"
#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* An object. False with the reason when the file can't be written. */
bool play_write_json(const PlayFigures *figures, const char *path, Error *error);

/* An array, as every `bench --json`. */
bool play_write_json_array(const PlayFigures *figures, size_t count, const char *path, Error *error);

/* The figures of `bench --play`, and what limits them. */
void play_print(const PlayFigures *figures, FILE *file);

#endif
