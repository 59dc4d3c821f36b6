#include "sim/base/base.h"
#include "sim/error.h"
#include "sim/world.h"

#include <pthread.h>
#include <search.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const struct {
    const char *name;
    StagePart part;
} stages[] = {
#define X(NAME, name, part) {name, part},
    STAGE_LIST(X)
#undef X
};

const char *stage_name(Stage stage)
{
    return stages[stage].name;
}

StagePart stage_part(Stage stage)
{
    return stages[stage].part;
}

const char *part_name(StagePart part)
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

typedef struct Kept {
    const void *bytes; /* of a kept copy: behind the struct */
    size_t size;
} Kept;

static int compare_kept(const void *a, const void *b)
{
    const Kept *one = a, *other = b;
    if (one->size != other->size)
        return one->size < other->size ? -1 : 1;
    return memcmp(one->bytes, other->bytes, one->size);
}

static Kept *kept_copy(const Kept *kept)
{
    Kept *copy = malloc(sizeof *copy + kept->size);
    if (!copy)
        return NULL;
    *copy = (Kept){copy + 1, kept->size};
    memcpy(copy + 1, kept->bytes, kept->size);
    return copy;
}

const void *bytes_keep(const void *bytes, size_t size)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static void *tree; /* of <search.h> */
    const Kept kept = {bytes, size};
    if (size == 0)
        return NULL;
    pthread_mutex_lock(&lock);
    Kept *const *found = tfind(&kept, &tree, compare_kept);
    if (!found) {
        Kept *copy = kept_copy(&kept);
        found = copy ? tsearch(copy, &tree, compare_kept) : NULL;
        if (!found)
            free(copy);
    }
    pthread_mutex_unlock(&lock);
    return found ? (*found)->bytes : NULL;
}

void *bytes_copy(const void *bytes, size_t size)
{
    void *copy = size > 0 ? malloc(size) : NULL;
    return copy ? memcpy(copy, bytes, size) : NULL;
}

const void *bytes_give(void *copy, size_t size)
{
    const void *kept = copy ? bytes_keep(copy, size) : NULL;
    free(copy);
    return kept;
}

const char *text_intern(const char *text)
{
    return bytes_keep(text, strlen(text) + 1);
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
