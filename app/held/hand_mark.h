/* Hash of a recording of motion devices, its mapping and its camera: a resumed run must use the same. */
#ifndef SLOSH_HAND_MARK_H
#define SLOSH_HAND_MARK_H

#include "app/device/mapping.h"
#include "app/device/report_log.h"

enum { HAND_MARK_SIZE = 17 };

/* Fills in 16 hexadecimal digits, equal for equal entries, mappings and axes (right, up, away). Returns
   false if memory is short. */
bool hand_mark(const ReportLog *log, const Mapping *mapping, const HandInput *axes,
               char mark[HAND_MARK_SIZE]);

#endif
