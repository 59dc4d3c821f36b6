#include "app/run/simulator_private.h"
#include "sim/state.h"
#include "sim/step/method.h"
#include "sim/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECE = 64 };

/* Bytes of a scene from byte `at` on; 0 beyond the scene's end. */
typedef struct SettingsPiece {
    size_t at;
    unsigned char bytes[PIECE];
} SettingsPiece;

/* Settings of the states from one change to the next: the pieces that differ from the past's base scene. */
typedef struct HistorySettings {
    size_t users, count;
    SettingsPiece piece[];
} HistorySettings;

typedef struct HistoryState {
    uint64_t place;
    size_t next, bytes;
    double work_ms; /* frame time since the previous state */
    HistorySettings *settings;
    WorldState state;
} HistoryState;

struct History {
    size_t bytes_most, bytes; /* of states, base, settings and places */
    size_t state_bytes;       /* of the last state */
    bool dropped;
    double work_ms;  /* frame time since the last state */
    int copies;      /* count of copied states */
    double byte_ms;  /* fastest copy, ms per byte */
    uint64_t before; /* count of forgotten places */
    size_t place_count, place_room;
    HistoryPlace *places;
    Scene *base;            /* NULL: no base and no states */
    size_t count, capacity; /* of the states; the oldest is first */
    HistoryState **states;
    WorldSaving saving; /* of the newest state, on its way from a GPU */
    double saving_ms;   /* time for its parts so far */
};

/* Makes room for one more element of `size` bytes. Returns false if memory is short. */
static bool grow(void **array, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity)
        return true;
    const size_t more = *capacity ? 2 * *capacity : 256;
    void *grown = realloc(*array, more * size);
    if (!grown)
        return false;
    *array = grown;
    *capacity = more;
    return true;
}

History *history_create(size_t bytes_most)
{
    History *history = calloc(1, sizeof *history);
    if (!history)
        return NULL;
    history->bytes_most = bytes_most;
    if (grow((void **)&history->places, 0, &history->place_room, sizeof *history->places))
        return history;
    free(history);
    return NULL;
}

static size_t settings_bytes(const HistorySettings *settings)
{
    return sizeof *settings + settings->count * sizeof *settings->piece;
}

static void settings_release(History *history, HistorySettings *settings)
{
    if (!settings || --settings->users > 0)
        return;
    history->bytes -= settings_bytes(settings);
    free(settings);
}

static void forget_base(History *history)
{
    history->bytes -= history->base ? sizeof *history->base : 0;
    free(history->base);
    history->base = NULL;
}

static void forget_saving(History *history, const HistoryState *states)
{
    if (history->saving.to == &states->state)
        history->saving.to = NULL;
}

static void kept_free(History *history, HistoryState *states)
{
    if (!states)
        return;
    forget_saving(history, states);
    history->bytes -= states->bytes;
    settings_release(history, states->settings);
    world_state_free(&states->state);
    free(states);
}

static void forget_states(History *history, size_t from)
{
    while (history->count > from)
        kept_free(history, history->states[--history->count]);
}

void history_destroy(History *history)
{
    if (!history)
        return;
    forget_states(history, 0);
    forget_base(history);
    world_save_end(&history->saving);
    free(history->states);
    free(history->places);
    free(history);
}

uint64_t history_last(const History *history)
{
    return history->before + history->place_count - 1;
}

uint64_t history_first(const History *history)
{
    return history->count > 0 ? history->states[0]->place : history_last(history);
}

HistoryPlace history_place(const History *history, uint64_t place)
{
    return history->places[place - history->before];
}

/* Removes unreachable places, once they are half of all. */
static void forget_places(History *history)
{
    const size_t gone = (size_t)(history_first(history) - history->before);
    if (gone < 128 || 2 * gone < history->place_count)
        return;
    history->place_count -= gone;
    history->before += gone;
    history->bytes -= gone * sizeof *history->places;
    memmove(history->places, history->places + gone, history->place_count * sizeof *history->places);
}

static void add_place(History *history, const WorldInfo *info)
{
    if (!grow((void **)&history->places, history->place_count, &history->place_room,
              sizeof *history->places)) {
        forget_states(history, 0); /* without memory only the present place remains */
        history->bytes -= history->place_count * sizeof *history->places;
        history->before += history->place_count;
        history->place_count = 0;
    }
    history->places[history->place_count++] = (HistoryPlace){info->step, info->time};
    history->bytes += sizeof *history->places;
}

void history_begin(History *history, const WorldInfo *info)
{
    forget_states(history, 0);
    forget_base(history);
    world_save_end(&history->saving); /* the next world may step on a thread without a context */
    history->bytes = history->place_count = 0;
    history->before = 0;
    history->work_ms = 0;
    history->dropped = false;
    add_place(history, info);
}

static size_t bytes_of(size_t particles, const WorldDef *def)
{
    const ColumnRows rows = columns_saved(def);
    size_t bytes = sizeof(HistoryState);
    for (int r = 0; r < rows.count; r++)
        bytes += (size_t)rows.row[r]->components * column_size(rows.row[r]) * (particles + COLUMN_PAST);
    return bytes;
}

static double reach(const History *history)
{
    return history_place(history, history_last(history)).time -
           history_place(history, history_first(history)).time;
}

/* Removes the state from the list and returns it. */
static HistoryState *take_out(History *history, size_t at)
{
    HistoryState *out = history->states[at];
    history->count--;
    memmove(history->states + at, history->states + at + 1, (history->count - at) * sizeof(HistoryState *));
    return out;
}

/* Index of the first state whose removal leaves the shortest jump between its neighbours; 0: none may go. */
static size_t find_needless(const History *history)
{
    double least = reach(history) < HISTORY_WANTED_S ? HISTORY_GAP_SHORT_MS : HISTORY_GAP_MOST_MS;
    size_t needless = 0;
    for (size_t i = 1; i + 1 < history->count; i++) {
        const double gap = history->states[i]->work_ms + history->states[i + 1]->work_ms;
        if (gap < least) {
            least = gap;
            needless = i;
        }
    }
    return needless;
}

/* Removes a dispensable state and returns it; NULL: no states. */
static HistoryState *thin_out(History *history)
{
    const size_t needless = find_needless(history);
    if (history->count == 0)
        return NULL;
    if (needless > 0)
        history->states[needless + 1]->work_ms += history->states[needless]->work_ms;
    HistoryState *out = take_out(history, needless);
    history->dropped |= needless == 0 && reach(history) < HISTORY_WANTED_S;
    return out;
}

/* Removes states until `more` bytes fit. Returns one removed state for reuse, or NULL. */
static HistoryState *make_room(History *history, size_t more)
{
    HistoryState *again = NULL;
    while (history->bytes + more > history->bytes_most && history->count > 0) {
        kept_free(history, again);
        again = thin_out(history);
        forget_saving(history, again);
        history->bytes -= again->bytes;
        again->bytes = 0;
    }
    return again;
}

void history_add_place(History *history, const WorldInfo *info, double frame_ms)
{
    history->work_ms += frame_ms;
    forget_places(history);
    add_place(history, info);
    kept_free(history, make_room(history, 0));
}

/* Differing padding only costs a piece. */
static bool same_bytes(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static size_t piece_size(size_t at)
{
    return sizeof(Scene) - at < PIECE ? sizeof(Scene) - at : PIECE;
}

/* Counts the pieces of `scene` that differ from the base; `to` gets the pieces and may be NULL. */
static size_t differing(const Scene *base, const Scene *scene, SettingsPiece *to)
{
    const unsigned char *a = (const unsigned char *)base, *b = (const unsigned char *)scene;
    size_t count = 0;
    for (size_t at = 0; at < sizeof *scene; at += PIECE) {
        if (same_bytes(a + at, b + at, piece_size(at)))
            continue;
        if (to) {
            to[count].at = at;
            memcpy(to[count].bytes, b + at, piece_size(at));
        }
        count++;
    }
    return count;
}

static HistorySettings *settings_new(const History *history, const Scene *scene)
{
    const size_t count = differing(history->base, scene, NULL);
    HistorySettings *settings = calloc(1, sizeof *settings + count * sizeof(SettingsPiece));
    if (!settings)
        return NULL;
    settings->users = 1;
    settings->count = count;
    differing(history->base, scene, settings->piece);
    return settings;
}

static bool settings_equal(const HistorySettings *a, const HistorySettings *b)
{
    return a->count == b->count && same_bytes(a->piece, b->piece, a->count * sizeof(SettingsPiece));
}

static void settings_apply(const History *history, const HistorySettings *settings, Scene *scene)
{
    memcpy(scene, history->base, sizeof *scene);
    for (size_t i = 0; i < settings->count; i++) {
        const SettingsPiece *piece = &settings->piece[i];
        memcpy((unsigned char *)scene + piece->at, piece->bytes, piece_size(piece->at));
    }
}

/* Keeps the first scene as base for the following scenes. */
static bool follow_base(History *history, const Scene *scene)
{
    if (history->base)
        return true;
    history->base = malloc(sizeof *history->base);
    if (!history->base)
        return false;
    memcpy(history->base, scene, sizeof *scene); /* with padding, for comparisons */
    history->bytes += sizeof *scene;
    return true;
}

static HistorySettings *settings_of(History *history, const Scene *scene)
{
    HistorySettings *last = history->count > 0 ? history->states[history->count - 1]->settings : NULL;
    HistorySettings *settings = follow_base(history, scene) ? settings_new(history, scene) : NULL;
    if (settings && last && settings_equal(settings, last)) {
        free(settings);
        last->users++;
        return last;
    }
    history->bytes += settings ? settings_bytes(settings) : 0;
    return settings;
}

/* Copies take at most a fiftieth of the frame time: a copy of a million particles takes as long as some
   frames on a GPU. The first copies are slow due to other work, so their times are not used. */
static bool is_time(const History *history, size_t bytes)
{
    static const double FRAMES = 50;
    static const int ENOUGH = 3;
    const double copy = history->copies < ENOUGH ? 0 : history->byte_ms * (double)bytes;
    return history->work_ms >= fmax(HISTORY_GAP_MS, FRAMES * copy);
}

static void count_copy(History *history, double ms, size_t bytes)
{
    const double byte_ms = ms / (double)bytes;
    history->byte_ms = history->copies == 0 ? byte_ms : fmin(history->byte_ms, byte_ms);
    history->copies++;
}

/* Reads a part of the newest state, or `waits` for the rest. Without the GPU's answer the state is lost. */
static void save_on(History *history, bool waits)
{
    const double began = wall_ms();
    if (!history->saving.to)
        return;
    const bool answered = world_save_go_on(&history->saving, waits);
    history->saving_ms += wall_ms() - began;
    if (!answered)
        forget_states(history, history->count - 1);
    else if (!history->saving.to)
        count_copy(history, history->saving_ms, history->states[history->count - 1]->bytes);
}

/* Fills `states` with the present state, or begins to. */
static bool fill(History *history, HistoryState *states, World *world, const Scene *scene, size_t next)
{
    Error none;
    const double began = wall_ms();
    settings_release(history, states->settings);
    states->settings = NULL;
    if (!grow((void **)&history->states, history->count, &history->capacity, sizeof(HistoryState *)) ||
        !world_save_begin(world, &states->state, &history->saving, &none) ||
        !(states->settings = settings_of(history, scene)))
        return false;
    states->place = history_last(history);
    states->next = next;
    states->bytes =
        bytes_of(states->state.capacity, &scene->world) + states->state.births.capacity * sizeof(Birth);
    states->work_ms = history->work_ms;
    history->bytes += states->bytes;
    history->saving_ms = wall_ms() - began;
    if (!history->saving.to)
        count_copy(history, history->saving_ms, states->bytes);
    return true;
}

static bool is_due(const History *history, bool now)
{
    if (history->count > 0 && history->states[history->count - 1]->place == history_last(history))
        return false;
    return now || history->count == 0 || is_time(history, history->states[history->count - 1]->bytes);
}

void history_keep(History *history, World *world, const Scene *scene, size_t next, bool now)
{
    save_on(history, false);
    if (!is_due(history, now) || !world_is_valid(world)) /* waits, so that the copy is timed alone */
        return;
    WorldInfo info;
    world_info(world, &info);
    save_on(history, true);
    history->state_bytes = bytes_of(info.count, &scene->world) + world_births_bytes(world);
    if (history->count == 0)
        forget_base(history);
    const size_t own = history->state_bytes + sizeof(HistorySettings), whole = sizeof(Scene);
    const size_t needed = own + whole + history->place_count * sizeof *history->places;
    if (needed > history->bytes_most) { /* too large for even one state */
        history->dropped = true;
        return;
    }
    HistoryState *states = make_room(history, own + (history->base ? 0 : whole));
    if (!states)
        states = calloc(1, sizeof *states);
    if (!states || !fill(history, states, world, scene, next)) {
        kept_free(history, states);
        return;
    }
    history->states[history->count++] = states;
    history->work_ms = 0;
    kept_free(history, make_room(history, 0)); /* in case the new state is larger than the previous one */
}

uint64_t history_find(const History *history, double time)
{
    uint64_t low = history_first(history), high = history_last(history);
    while (low < high) {
        const uint64_t middle = low + (high - low + 1) / 2;
        if (history_place(history, middle).time <= time)
            low = middle;
        else
            high = middle - 1;
    }
    const bool failed = low == history_last(history) && low > history_first(history) &&
                        !(history_place(history, low - 1).time < history_place(history, low).time);
    return low - failed;
}

/* The last state at or before the place. */
static const HistoryState *kept_before(const History *history, uint64_t place)
{
    size_t low = 0, high = history->count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (history->states[middle]->place <= place)
            low = middle;
        else
            high = middle;
    }
    return history->states[low];
}

uint64_t history_state_before(const History *history, uint64_t place)
{
    return history->count > 0 ? kept_before(history, place)->place : history_last(history);
}

bool history_load(History *history, uint64_t place, World **world, Scene *scene, size_t *next, Error *error)
{
    Scene then;
    save_on(history, true);
    if (history->count == 0)
        return error_set(error, "no state of the past is kept");
    const HistoryState *states = kept_before(history, place);
    settings_apply(history, states->settings, &then);
    if (!world_load_shapes(world, &then.world, &states->state, error))
        return false;
    memcpy(scene, &then, sizeof then); /* with padding, for comparisons */
    *next = states->next;
    return true;
}

void history_cut(History *history, uint64_t place)
{
    size_t states = history->count;
    while (states > 0 && history->states[states - 1]->place > place)
        states--;
    forget_states(history, states);
    const size_t left = (size_t)(place - history->before) + 1;
    history->bytes -= (history->place_count - left) * sizeof *history->places;
    history->place_count = left;
    history->work_ms = HISTORY_GAP_MS; /* the frame time since the last state is unknown */
}

HistoryFigures history_figures(const History *history)
{
    return (HistoryFigures){.bytes = history->bytes,
                            .bytes_most = history->bytes_most,
                            .state_bytes = history->state_bytes,
                            .states = history->count,
                            .dropped = history->dropped};
}
