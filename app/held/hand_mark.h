/* What tells a recording of motion devices, with its mapping and its camera, from any other: so that a run is
   resumed with the same one. */
#ifndef SLOSH_HAND_MARK_H
#define SLOSH_HAND_MARK_H

#include "app/device/mapping.h"
#include "app/device/report_log.h"

enum { HAND_MARK_SIZE = 17 };

/* 16 hexadecimal digits, equal for equal entries, mappings and axes (right, up, away). False: no memory. */
bool hand_mark(const ReportLog *log, const Mapping *mapping, const HandInput *axes,
               char mark[HAND_MARK_SIZE]);

#endif
