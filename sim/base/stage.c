#include "slosh/error.h"
#include "slosh/world.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
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

void text_tame(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        const bool upper = *c == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0; /* U+0080 to U+009F in UTF-8 */
        if ((*c < ' ' && *c != '\n' && *c != '\t') || *c == 0x7f || upper)
            *c = '?';
        if (upper)
            *++c = '?';
    }
}

bool error_set(Error *error, const char *format, ...)
{
    if (error) {
        va_list args;
        va_start(args, format);
        vsnprintf(error->message, sizeof error->message, format, args);
        va_end(args);
        text_tame(error->message);
    }
    return false;
}

int number_digits(size_t count, int least)
{
    int digits = 1;
    for (size_t left = count > 0 ? (count - 1) / 10 : 0; left > 0; left /= 10)
        digits++;
    return digits > least ? digits : least;
}

void number_grouped(size_t number, char text[32])
{
    char digits[24];
    const int count = snprintf(digits, sizeof digits, "%zu", number);
    for (int i = 0; i < count; i++) {
        *text++ = digits[i];
        if (i + 1 < count && (count - i - 1) % 3 == 0)
            *text++ = ',';
    }
    *text = 0;
}

#define X(NAME, name, unit) {name, unit},
const ScalarRow scalar_list[] = {SCALAR_LIST(X){NULL, NULL}};
const ScalarRow vector_list[] = {VECTOR_LIST(X){NULL, NULL}};
#undef X

const char *scalar_name(Scalar scalar)
{
    return scalar_list[scalar].name;
}

const char *scalar_unit(Scalar scalar)
{
    return scalar_list[scalar].unit;
}
