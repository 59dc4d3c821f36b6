/* Fuzz target of the recording's parser: what it takes keeps its own rules, what it refuses it gives a reason
 * for. */
#include "app/recording.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Recording recording;
    Error error = {""};
    if (!recording_parse("fuzz", (const char *)data, size, &recording, &error)) {
        must(strncmp(error.message, "fuzz:", 5) == 0 && !recording.text && !recording.commands);
        return 0;
    }
    must(recording.text && recording.settings.count <= SCENE_SETTINGS_MAX);
    for (size_t i = 0; i < recording.count; i++) {
        const SimCommand *command = &recording.commands[i];
        must(i == 0 || command->step >= recording.commands[i - 1].step);
        must(!recording.complete || command->step <= recording.steps);
        must(command->kind == SIM_SET
                 ? strlen(command->setting) < SIM_SETTING_SIZE
                 : isfinite(command->target.position[0] + command->target.orientation[3]));
    }
    recording_destroy(&recording);
    return 0;
}
