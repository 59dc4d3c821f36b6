/* Fuzz target of the parsers of motion devices. The first byte chooses the layout, the second a
   calibration and whether checksums are mended; then reports follow, each after a length. Rejected
   reports change no state, accepted reports give finite numbers within sensor range. */
#include "app/input/device/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

static void seal(uint8_t kind, uint8_t *bytes, size_t size)
{
    const uint32_t sum = size >= 4 ? checksum_of(kind, bytes, size - 4) : 0;
    for (size_t i = 0; i < 4 && size >= 4; i++)
        bytes[size - 4 + i] = (uint8_t)(sum >> 8 * i);
}

static const DeviceRow *row_with(ReportLayout layout)
{
    const DeviceRow *row = device_rows;
    while (row->usb != layout && row->bluetooth != layout)
        row++;
    return row;
}

static void check_range(const DeviceState *state)
{
    for (int k = 0; k < 6; k++)
        must(fabs(state->cap[k]) <= 1);
    for (int k = 0; k < 2; k++)
        must(fabs(state->left[k]) <= 1 && fabs(state->right[k]) <= 1 &&
             fabs(state->triggers[k] - 0.5) <= 0.5);
    for (int k = 0; k < 3; k++) /* twice the nominal scale at the most, 16 bits, and a zero half a g away */
        must(fabs(state->angular_velocity[k]) < 72 && fabs(state->acceleration[k]) < 90);
}

/* The bytes in memory of the exact length, so that a read beyond is detected. */
static uint8_t *copy_of(const uint8_t *bytes, size_t size)
{
    uint8_t *copy = malloc(size ? size : 1);
    must(copy != NULL);
    memcpy(copy, bytes, size);
    return copy;
}

static void parse_one(const ReportFormat *format, bool sealed, const uint8_t *bytes, size_t size,
                      DeviceState *state)
{
    DeviceState before;
    uint8_t *copy = copy_of(bytes, size);
    if (sealed)
        seal(CHECKSUM_INPUT, copy, size);
    memcpy(&before, state, sizeof before);
    if (report_parse(format, copy, size, 1, state)) {
        must(state->reports == before.reports + 1 && state->refused == before.refused);
        check_range(state);
    } else {
        before.refused++;
        must(memcmp(&before, state, sizeof before) == 0);
    }
    free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    const ReportLayout layout = (ReportLayout)(data[0] % LAYOUT_COUNT);
    const bool sealed = data[1] & 1, calibrated = data[1] & 2;
    ReportFormat format = {.row = row_with(layout), .layout = layout, .calibration = calibration_nominal()};
    DeviceState state;
    memset(&state, 0, sizeof state);
    bool first = calibrated;
    for (size_t at = 2; at < size; first = false) {
        const size_t left = size - at - 1, length = data[at] < left ? data[at] : left;
        at++;
        if (first) {
            uint8_t *copy = copy_of(data + at, length);
            if (sealed)
                seal(CHECKSUM_FEATURE, copy, length);
            calibration_parse(layout, copy, length, &format.calibration);
            free(copy);
        } else {
            parse_one(&format, sealed, data + at, length, &state);
        }
        at += length;
    }
    return 0;
}
