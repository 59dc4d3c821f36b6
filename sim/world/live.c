#include "sim/world/live.h"

#include "sim/base/key.h"
#include "sim/world/method.h"

#include <assert.h>
#include <math.h>
#include <string.h>

extern const Key box_keys[], solver_keys[], step_keys[], fluid_keys[]; /* sim/matter */
extern const Key hand_keys[];                                          /* sim/box */

/* Key rows and the offset of their struct in a WorldDef. The saved state keeps this order. */
static const struct {
    const Key *rows;
    size_t at;
} groups[] = {
    {box_keys, 0}, {solver_keys, 0}, {step_keys, 0}, {hand_keys, offsetof(WorldDef, limits)}, {fluid_keys, 0},
};

enum { MEMBERS_MAX = 64 };

/* A member of the def, filled by a row: contiguous numbers. */
typedef struct Member {
    const Key *key, *list; /* the row; the list with the member in its elements, or NULL */
    KeyType type;
    int numbers;
    size_t at; /* offset in a WorldDef; for a list, of the first element */
} Member;

typedef struct Members {
    int count;
    Member of[MEMBERS_MAX];
} Members;

static void add(Members *members, const Member *member)
{
    assert(members->count < MEMBERS_MAX);
    members->of[members->count++] = *member;
}

/* A row with a table gives two members: the number and the table. */
static void add_row(Members *members, const Key *key, const Key *list, size_t at)
{
    Member member = {.key = key, .list = list, .type = key->type, .numbers = key->type == KEY_VEC3 ? 3 : 1};
    const size_t base = at + (list ? list->offset : 0);
    member.at = base + key->offset;
    add(members, &member);
    if (key->type != KEY_CURVE)
        return;
    member.at = base + key->aux;
    member.numbers = sizeof(TimeTable) / sizeof(double);
    add(members, &member);
}

static Members members_of_rows(void)
{
    Members members = {.count = 0};
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        const Key *list = NULL;
        for (const Key *key = groups[g].rows; key->path; key++) {
            if (key->type == KEY_LIST && !strstr(key->path, "[]"))
                list = key;
            if (key->flags & KEY_LIVE && !(key->flags & KEY_IDLE))
                add_row(&members, key, strstr(key->path, "[]") ? list : NULL, groups[g].at);
        }
    }
    return members;
}

static int room_for(const Member *member)
{
    return member->list ? (int)member->list->max : 1;
}

static int elements_in(const Member *member, const WorldDef *def)
{
    const char *base = (const char *)def;
    return member->list ? *(const int *)(const void *)(base + member->list->aux) : 1;
}

static size_t place(const Member *member, int element)
{
    return member->at + (member->list ? (size_t)element * member->list->size : 0);
}

static double get(const Member *member, const void *field, int k)
{
    switch (member->type) {
    case KEY_BOOLEAN:
        return ((const bool *)field)[k];
    case KEY_INTEGER:
    case KEY_CHOICE:
        return ((const int *)field)[k];
    default:
        return ((const double *)field)[k];
    }
}

static void put(const Member *member, void *field, int k, double number)
{
    switch (member->type) {
    case KEY_BOOLEAN:
        ((bool *)field)[k] = number != 0;
        break;
    case KEY_INTEGER:
    case KEY_CHOICE:
        ((int *)field)[k] = (int)number;
        break;
    default:
        ((double *)field)[k] = number;
    }
}

void live_save(const WorldDef *def, double numbers[LIVE_NUMBERS])
{
    const Members members = members_of_rows();
    for (const Member *m = members.of; m < members.of + members.count; m++) {
        for (int e = 0; e < elements_in(m, def); e++)
            for (int k = 0; k < m->numbers; k++)
                numbers[e * m->numbers + k] = get(m, (const char *)def + place(m, e), k);
        numbers += room_for(m) * m->numbers;
    }
}

void live_load(const double numbers[LIVE_NUMBERS], WorldDef *def)
{
    const Members members = members_of_rows();
    for (const Member *m = members.of; m < members.of + members.count; m++) {
        for (int e = 0; e < elements_in(m, def); e++)
            for (int k = 0; k < m->numbers; k++)
                put(m, (char *)def + place(m, e), k, numbers[e * m->numbers + k]);
        numbers += room_for(m) * m->numbers;
    }
}

static void copy_rows(const Key *rows, const char *from, char *to)
{
    for (const Key *key = rows; key && key->path; key++) {
        Members members = {.count = 0};
        if (key->flags & KEY_LIVE)
            add_row(&members, key, NULL, 0);
        for (const Member *m = members.of; m < members.of + members.count; m++)
            for (int k = 0; k < m->numbers; k++)
                put(m, to + m->at, k, get(m, from + m->at, k));
    }
}

void live_copy(const WorldDef *from, WorldDef *to)
{
    double numbers[LIVE_NUMBERS] = {0};
    live_save(from, numbers);
    live_load(numbers, to);
    for (const Method *const *m = method_list(); *m; m++)
        copy_rows((*m)->keys, method_def(from, *m), method_def(to, *m));
}

bool live_sound(const double numbers[LIVE_NUMBERS])
{
    const Members members = members_of_rows();
    for (const Member *m = members.of; m < members.of + members.count; m++) {
        const bool whole = m->type == KEY_INTEGER || m->type == KEY_CHOICE;
        for (int k = 0; whole && k < room_for(m) * m->numbers; k++)
            if (!(numbers[k] >= m->key->min && numbers[k] < 0x1p31))
                return false;
        numbers += room_for(m) * m->numbers;
    }
    return true;
}

int live_count(void)
{
    const Members members = members_of_rows();
    int count = 0;
    for (const Member *m = members.of; m < members.of + members.count; m++)
        count += room_for(m) * m->numbers;
    return count;
}
