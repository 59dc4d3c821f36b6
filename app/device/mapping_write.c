/* Writes mappings as a file and in words. */
#include "app/device/device_table.h"
#include "app/device/mapping_keys.h"
#include "sim/base/key_text.h"

#include <errno.h>
#include <string.h>

/* Writes "{to: move_x, as: rate, gain: 1, invert: false}". */
static void write_rows(const Key *rows, const void *base, FILE *file)
{
    fputc('{', file);
    for (const Key *row = rows; row->path; row++) {
        char value[64];
        key_value_text(row, base, value, sizeof value);
        fprintf(file, "%s%s: %s", row == rows ? "" : ", ", row->path, value);
    }
    fputc('}', file);
}

static const char *command_name(int command)
{
    return command == PLAY_NONE ? "nothing" : mapping_command_name(command);
}

/* Writes the buttons with a command, here or in the reader's default; names the rest in a comment. */
static void write_buttons(const DeviceMap *map, const DeviceMap *begin, FILE *file)
{
    int others = 0;
    fprintf(file, "  buttons:\n");
    for (int i = 0; i < map->button_count; i++) {
        const ButtonMap *button = &map->buttons[i];
        if (button->command != PLAY_NONE || begin->buttons[i].command != PLAY_NONE)
            fprintf(file, "    %s: %s\n", button->name, command_name(button->command));
    }
    for (int i = 0; i < map->button_count; i++)
        if (map->buttons[i].command == PLAY_NONE)
            fprintf(file, "%s%s", others++ ? ", " : "    # also ", map->buttons[i].name);
    fprintf(file, others ? "\n" : "");
}

static void write_device(const DeviceMap *map, const DeviceMap *begin, FILE *file)
{
    for (const Key *row = mapping_device_keys; row->path; row++) {
        char value[64];
        key_value_text(row, map, value, sizeof value);
        fprintf(file, "  %s: %s\n", row->path, value);
    }
    if (mapping_has_pose(map->family)) {
        fprintf(file, "  pose: ");
        write_rows(mapping_pose_keys, map, file);
        fputc('\n', file);
    }
    fprintf(file, "  axes:\n");
    for (int i = 0; i < MAPPING_AXES; i++) {
        fprintf(file, "    %s: ", mapping_axis_name(map->family, i));
        write_rows(mapping_axis_keys, &map->axes[i], file);
        fputc('\n', file);
    }
    write_buttons(map, begin, file);
}

static void write_keys(const char *of, const Key *rows, FILE *file)
{
    for (const Key *row = rows; row->path; row++) {
        char range[256];
        key_range_text(row, range, sizeof range);
        fprintf(file, "#   %s%s: %s: %s\n", of, row->path, row->help, range);
    }
}

static void write_commands(FILE *file)
{
    const char *name;
    for (int i = 0; (name = mapping_command_name(i)); i++)
        if (*name)
            fprintf(file, "#     %-16s %s\n", name, play_command_rows[i].help);
}

void mapping_write(const Mapping *mapping, FILE *file)
{
    char user[1024];
    Mapping built_in;
    mapping_default(&built_in);
    fprintf(file, "# What the axes, the buttons and the pose of motion devices do.");
    if (mapping_user_path(user))
        fprintf(file, " slosh reads it as\n# %s, or where `--mapping FILE` says.", user);
    fprintf(file, "\n# Directions are yours: x to the right, y up, z towards you, turns right-handed about "
                  "these.\n# What is left out is as built in. Keys:\n");
    write_keys("", mapping_device_keys, file);
    write_keys("pose.", mapping_pose_keys, file);
    write_keys("axes.NAME.", mapping_axis_keys, file);
    fprintf(file, "#   buttons.NAME: nothing, or a command of the window:\n");
    write_commands(file);
    fprintf(file,
            "# A product may have an entry of its own, such as 256f:c635; it begins with its family's.\n");
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++) {
        fprintf(file, "\n%s:\n", device_family_word((DeviceFamily)f));
        write_device(&mapping->family[f], &built_in.family[f], file);
    }
    for (int i = 0; i < mapping->own_count; i++) {
        fprintf(file, "\n%04x:%04x:\n", mapping->own[i].vendor, mapping->own[i].product);
        write_device(&mapping->own[i].map, &mapping->family[mapping->own[i].map.family], file);
    }
}

bool mapping_write_new(const Mapping *mapping, const char *path, Error *error)
{
    FILE *file = fopen(path, "wx");
    if (!file && errno == EEXIST)
        return error_set(error, "%s: is there already, and stays as it is; name a new file", path);
    if (!file)
        return error_set(error, "%s: cannot be written (%s); name a file in a folder that is there", path,
                         strerror(errno));
    mapping_write(mapping, file);
    const bool failed = ferror(file) != 0;
    if (fclose(file) == 0 && !failed)
        return true;
    error_set(error, "%s: cannot be written whole (%s); make room for it", path, strerror(errno));
    remove(path);
    return false;
}

static void explain_axis(const DeviceMap *map, int axis, FILE *file)
{
    const AxisMap *row = &map->axes[axis];
    const bool speed = row->as == MAP_RATE || row->to >= MAP_ORBIT_X;
    fprintf(file, "  %-14s %s", mapping_axis_name(map->family, axis), mapping_to_words(row->to));
    if (row->to != MAP_NOTHING) {
        fprintf(file, speed ? ", as a speed" : ", for as long as it is held");
        if (row->gain != 1)
            fprintf(file, ", %g-fold", row->gain);
        if (row->invert)
            fprintf(file, ", the other way round");
    }
    fputc('\n', file);
}

static void explain_device(const DeviceMap *map, FILE *file)
{
    fprintf(file, "gain %g, dead zone %g, curve %g\n", map->gain, map->dead_zone, map->curve);
    if (map->pose)
        fprintf(file, "  %-14s turns the box as the device is turned, %g-fold\n", "pose", map->pose_gain);
    for (int i = 0; i < MAPPING_AXES; i++)
        explain_axis(map, i, file);
    for (int i = 0; i < map->button_count; i++)
        if (map->buttons[i].command != PLAY_NONE)
            fprintf(file, "  %-14s %s\n", map->buttons[i].name,
                    play_command_rows[map->buttons[i].command].help);
}

void mapping_explain(const Mapping *mapping, FILE *file)
{
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++) {
        fprintf(file, "%s%s: ", f ? "\n" : "", device_family_title((DeviceFamily)f));
        explain_device(&mapping->family[f], file);
    }
    for (int i = 0; i < mapping->own_count; i++) {
        fprintf(file, "\n%s: ", device_row(mapping->own[i].vendor, mapping->own[i].product)->name);
        explain_device(&mapping->own[i].map, file);
    }
}
