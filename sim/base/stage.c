#include "sim/base/stage.h"

#include <time.h>

static const struct {
    const char *name;
    Part part;
} stages[] = {
#define X(NAME, name, part) {name, part},
    STAGE_LIST(X)
#undef X
};

const char *stage_name(Stage stage)
{
    return stages[stage].name;
}

Part stage_part(Stage stage)
{
    return stages[stage].part;
}

const char *part_name(Part part)
{
    static const char *const names[] = {
        [PART_SIM] = "sim", [PART_UPLOAD] = "upload", [PART_RENDER] = "render"};
    return names[part];
}

double wall_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

void stage_begin(StageClock *clock)
{
    if (clock && clock->gpu)
        clock->gpu_begin(clock->gpu);
    else if (clock)
        clock->began_ms = wall_ms();
}

void stage_end(StageClock *clock, Stage stage)
{
    if (!clock)
        return;
    if (clock->gpu) {
        clock->gpu_end(clock->gpu, stage);
        return;
    }
    clock->frame.ms[stage] += wall_ms() - clock->began_ms;
    clock->frame.ran[stage] = true;
}
