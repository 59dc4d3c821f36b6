#include "app/device/device_survey.h"

#include <stdlib.h>
#include <string.h>

enum { INFOS_MAX = 256 };

static bool has_path(const DeviceFound *found, int count, const char *path)
{
    for (int i = 0; i < count; i++)
        if (strcmp(found[i].info.path, path) == 0)
            return true;
    return false;
}

static void try_open(const HidPort *port, DeviceFound *found)
{
    HidRefusal why = HID_FAILED;
    char reason[HID_REASON_SIZE] = "";
    void *handle = port->open(port->self, found->info.path, &why, reason);
    if (handle)
        port->close(handle);
    else
        device_trouble(found->row, why, reason, found->problem);
}

int device_survey(const HidPort *port, DeviceFound out[DEVICE_SURVEY_MAX])
{
    HidInfo *infos = malloc(INFOS_MAX * sizeof *infos);
    const int seen = infos ? port->enumerate(port->self, infos, INFOS_MAX) : -1;
    int count = seen < 0 || seen > INFOS_MAX ? -1 : 0;
    for (int i = 0; i < seen && count >= 0 && count < DEVICE_SURVEY_MAX; i++) {
        const DeviceRow *row = device_match(&infos[i]);
        if (!row || has_path(out, count, infos[i].path))
            continue;
        out[count] = (DeviceFound){.info = infos[i], .row = row};
        try_open(port, &out[count++]);
    }
    free(infos);
    return count;
}
