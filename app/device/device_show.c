#include "app/device/device_show.h"

#include <math.h>
#include <stddef.h>

/* A group of related values. */
typedef struct Group {
    const char *label, *names, *unit; /* names: one letter per value */
    size_t offset;                    /* of a double[] in DeviceState */
    int count;
    double least, most; /* ends of the bars */
} Group;

#define AT(field) offsetof(DeviceState, field)

static const Group cap_groups[] = {
    {"move", "xyz", "", AT(cap), 3, -1, 1},
    {"turn", "xyz", "", AT(cap[3]), 3, -1, 1},
    {0},
};

static const Group pad_groups[] = {
    {"turn", "xyz", " rad/s", AT(angular_velocity), 3, -5, 5},
    {"feel", "xyz", " m/s2", AT(acceleration), 3, -20, 20},
    {"left", "xy", "", AT(left), 2, -1, 1},
    {"right", "xy", "", AT(right), 2, -1, 1},
    {"pull", "lr", "", AT(triggers), 2, 0, 1},
    {0},
};

static const Group *groups_of(const DeviceRow *row)
{
    return row->family == DEVICE_SPACEMOUSE ? cap_groups : pad_groups;
}

static double value_of(const Group *group, const DeviceState *state, int k)
{
    const double *values = (const double *)((const char *)state + group->offset);
    return values[k] + 0.0; /* turns -0 into 0 */
}

static void show_buttons(FILE *file, const DeviceRow *row, uint32_t buttons)
{
    fputs("buttons", file);
    for (int bit = 0; bit < DEVICE_BUTTONS_MAX; bit++) {
        if (!(buttons >> bit & 1))
            continue;
        if (row->buttons[bit])
            fprintf(file, " %s", row->buttons[bit]);
        else
            fprintf(file, " bit%d", bit);
    }
}

void device_show_line(FILE *file, const DeviceRow *row, const DeviceState *state)
{
    for (const Group *group = groups_of(row); group->label; group++) {
        fputs(group->label, file);
        for (int k = 0; k < group->count; k++)
            fprintf(file, " %+.2f", value_of(group, state, k));
        fprintf(file, "%s, ", group->unit);
    }
    show_buttons(file, row, state->buttons);
}

/* Prints a bar such as "[ ##| ]" from zero to the value. */
static void show_bar(FILE *file, const Group *group, double value)
{
    enum { CELLS = 10 }; /* for three bars with values in 80 columns */
    char bar[CELLS + 1];
    const double span = group->most - group->least;
    const int zero = (int)lround(-group->least / span * CELLS);
    const double shown = fmin(fmax(value, group->least), group->most);
    const int place = zero + (int)lround(shown / span * CELLS);
    for (int i = 0; i < CELLS; i++)
        bar[i] = (i >= zero && i < place) || (i < zero && i >= place) ? '#' : ' ';
    bar[CELLS] = 0;
    if (zero > 0)
        fprintf(file, "[%.*s|%s]", zero, bar, bar + zero);
    else
        fprintf(file, "[%s]", bar);
}

void device_show_bars(FILE *file, const DeviceRow *row, const DeviceState *state)
{
    for (const Group *group = groups_of(row); group->label; group++) {
        fprintf(file, "  %-5s", group->label);
        for (int k = 0; k < group->count; k++) {
            const double value = value_of(group, state, k);
            fprintf(file, " %c", group->names[k]);
            show_bar(file, group, value);
            fprintf(file, "%+7.2f", value);
        }
        fprintf(file, "%s\n", group->unit);
    }
    fputs("  ", file);
    show_buttons(file, row, state->buttons);
    fputc('\n', file);
}
