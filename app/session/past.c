#include "app/session/past.h"

#include "sim/base/stage.h"
#include "sim/world/method.h"
#include "sim/world/world_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECE = 64 };

/* Bytes of a scene from byte `at` on; 0 beyond the scene's end. */
typedef struct Piece {
    size_t at;
    unsigned char bytes[PIECE];
} Piece;

/* Settings of the states from one change to the next: the pieces that differ from the past's base scene. */
typedef struct Settings {
    size_t users, count;
    Piece piece[];
} Settings;

typedef struct Kept {
    uint64_t place;
    size_t next, bytes;
    double work_ms; /* frame time since the previous state */
    Settings *settings;
    WorldState state;
} Kept;

struct Past {
    size_t bytes_most, bytes; /* of states, base, settings and places */
    size_t state_bytes;       /* of the last state */
    bool dropped;
    double work_ms;  /* frame time since the last state */
    int copies;      /* count of copied states */
    double byte_ms;  /* fastest copy, ms per byte */
    uint64_t before; /* count of forgotten places */
    size_t place_count, place_room;
    PastPlace *places;
    Scene *base;        /* NULL: no base and no states */
    size_t count, room; /* of the states; the oldest is first */
    Kept **kept;
};

/* Makes room for one more element of `size` bytes. Returns false if memory is short. */
static bool grow(void **array, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return true;
    const size_t more = *room ? 2 * *room : 256;
    void *grown = realloc(*array, more * size);
    if (!grown)
        return false;
    *array = grown;
    *room = more;
    return true;
}

Past *past_create(size_t bytes_most)
{
    Past *past = calloc(1, sizeof *past);
    if (!past)
        return NULL;
    past->bytes_most = bytes_most;
    if (grow((void **)&past->places, 0, &past->place_room, sizeof *past->places))
        return past;
    free(past);
    return NULL;
}

static size_t settings_bytes(const Settings *settings)
{
    return sizeof *settings + settings->count * sizeof *settings->piece;
}

static void settings_release(Past *past, Settings *settings)
{
    if (!settings || --settings->users > 0)
        return;
    past->bytes -= settings_bytes(settings);
    free(settings);
}

static void forget_base(Past *past)
{
    past->bytes -= past->base ? sizeof *past->base : 0;
    free(past->base);
    past->base = NULL;
}

static void kept_free(Past *past, Kept *kept)
{
    if (!kept)
        return;
    past->bytes -= kept->bytes;
    settings_release(past, kept->settings);
    world_state_free(&kept->state);
    free(kept);
}

static void forget_states(Past *past, size_t from)
{
    while (past->count > from)
        kept_free(past, past->kept[--past->count]);
}

void past_destroy(Past *past)
{
    if (!past)
        return;
    forget_states(past, 0);
    forget_base(past);
    free(past->kept);
    free(past->places);
    free(past);
}

uint64_t past_last(const Past *past)
{
    return past->before + past->place_count - 1;
}

uint64_t past_first(const Past *past)
{
    return past->count > 0 ? past->kept[0]->place : past_last(past);
}

PastPlace past_place(const Past *past, uint64_t place)
{
    return past->places[place - past->before];
}

/* Removes unreachable places, once they are half of all. */
static void forget_places(Past *past)
{
    const size_t gone = (size_t)(past_first(past) - past->before);
    if (gone < 128 || 2 * gone < past->place_count)
        return;
    past->place_count -= gone;
    past->before += gone;
    past->bytes -= gone * sizeof *past->places;
    memmove(past->places, past->places + gone, past->place_count * sizeof *past->places);
}

static void add_place(Past *past, const WorldInfo *info)
{
    if (!grow((void **)&past->places, past->place_count, &past->place_room, sizeof *past->places)) {
        forget_states(past, 0); /* without memory only the present place remains */
        past->bytes -= past->place_count * sizeof *past->places;
        past->before += past->place_count;
        past->place_count = 0;
    }
    past->places[past->place_count++] = (PastPlace){info->step, info->time};
    past->bytes += sizeof *past->places;
}

void past_begin(Past *past, const WorldInfo *info)
{
    forget_states(past, 0);
    forget_base(past);
    past->bytes = past->place_count = 0;
    past->before = 0;
    past->work_ms = 0;
    past->dropped = false;
    add_place(past, info);
}

static size_t bytes_of(size_t particles, const WorldDef *def)
{
    const ColumnRows rows = columns_saved(def);
    size_t bytes = sizeof(Kept);
    for (int r = 0; r < rows.count; r++)
        bytes += (size_t)rows.row[r]->components * column_size(rows.row[r]) * (particles + COLUMN_PAST);
    return bytes;
}

static double reach(const Past *past)
{
    return past_place(past, past_last(past)).time - past_place(past, past_first(past)).time;
}

/* Removes the state from the list and returns it. */
static Kept *take_out(Past *past, size_t at)
{
    Kept *out = past->kept[at];
    past->count--;
    memmove(past->kept + at, past->kept + at + 1, (past->count - at) * sizeof(Kept *));
    return out;
}

/* Index of the first state whose removal leaves the shortest jump between its neighbours; 0: none may go. */
static size_t find_needless(const Past *past)
{
    double least = reach(past) < PAST_WISH_S ? PAST_GAP_SHORT_MS : PAST_GAP_MOST_MS;
    size_t needless = 0;
    for (size_t i = 1; i + 1 < past->count; i++) {
        const double gap = past->kept[i]->work_ms + past->kept[i + 1]->work_ms;
        if (gap < least) {
            least = gap;
            needless = i;
        }
    }
    return needless;
}

/* Removes a dispensable state and returns it; NULL: no states. */
static Kept *thin_out(Past *past)
{
    const size_t needless = find_needless(past);
    if (past->count == 0)
        return NULL;
    if (needless > 0)
        past->kept[needless + 1]->work_ms += past->kept[needless]->work_ms;
    Kept *out = take_out(past, needless);
    past->dropped |= needless == 0 && reach(past) < PAST_WISH_S;
    return out;
}

/* Removes states until `more` bytes fit. Returns one removed state for reuse, or NULL. */
static Kept *make_room(Past *past, size_t more)
{
    Kept *again = NULL;
    while (past->bytes + more > past->bytes_most && past->count > 0) {
        kept_free(past, again);
        again = thin_out(past);
        past->bytes -= again->bytes;
        again->bytes = 0;
    }
    return again;
}

void past_mark(Past *past, const WorldInfo *info, double frame_ms)
{
    past->work_ms += frame_ms;
    forget_places(past);
    add_place(past, info);
    kept_free(past, make_room(past, 0));
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
static size_t differing(const Scene *base, const Scene *scene, Piece *to)
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

static Settings *settings_new(const Past *past, const Scene *scene)
{
    const size_t count = differing(past->base, scene, NULL);
    Settings *settings = calloc(1, sizeof *settings + count * sizeof(Piece));
    if (!settings)
        return NULL;
    settings->users = 1;
    settings->count = count;
    differing(past->base, scene, settings->piece);
    return settings;
}

static bool settings_equal(const Settings *a, const Settings *b)
{
    return a->count == b->count && same_bytes(a->piece, b->piece, a->count * sizeof(Piece));
}

static void settings_apply(const Past *past, const Settings *settings, Scene *scene)
{
    memcpy(scene, past->base, sizeof *scene);
    for (size_t i = 0; i < settings->count; i++) {
        const Piece *piece = &settings->piece[i];
        memcpy((unsigned char *)scene + piece->at, piece->bytes, piece_size(piece->at));
    }
}

/* Keeps the first scene as base for the following scenes. */
static bool follow_base(Past *past, const Scene *scene)
{
    if (past->base)
        return true;
    past->base = malloc(sizeof *past->base);
    if (!past->base)
        return false;
    memcpy(past->base, scene, sizeof *scene); /* with padding, for comparisons */
    past->bytes += sizeof *scene;
    return true;
}

static Settings *settings_of(Past *past, const Scene *scene)
{
    Settings *last = past->count > 0 ? past->kept[past->count - 1]->settings : NULL;
    Settings *settings = follow_base(past, scene) ? settings_new(past, scene) : NULL;
    if (settings && last && settings_equal(settings, last)) {
        free(settings);
        last->users++;
        return last;
    }
    past->bytes += settings ? settings_bytes(settings) : 0;
    return settings;
}

/* Copies take at most a fiftieth of the frame time: a copy of a million particles takes as long as some
   frames on a GPU. The first copies are slow due to other work, so their times are not used. */
static bool is_time(const Past *past, size_t bytes)
{
    static const double FRAMES = 50;
    static const int ENOUGH = 3;
    const double copy = past->copies < ENOUGH ? 0 : past->byte_ms * (double)bytes;
    return past->work_ms >= fmax(PAST_GAP_MS, FRAMES * copy);
}

static void count_copy(Past *past, double ms, size_t bytes)
{
    const double byte_ms = ms / (double)bytes;
    past->byte_ms = past->copies == 0 ? byte_ms : fmin(past->byte_ms, byte_ms);
    past->copies++;
}

/* Fills `kept` with the present state. */
static bool fill(Past *past, Kept *kept, World *world, const Scene *scene, size_t next)
{
    Error none;
    const double began = wall_ms();
    settings_release(past, kept->settings);
    kept->settings = NULL;
    if (!grow((void **)&past->kept, past->count, &past->room, sizeof(Kept *)) ||
        !world_save(world, &kept->state, &none) || !(kept->settings = settings_of(past, scene)))
        return false;
    kept->place = past_last(past);
    kept->next = next;
    kept->bytes = bytes_of(kept->state.capacity, &scene->world) + kept->state.births.room * sizeof(Birth);
    kept->work_ms = past->work_ms;
    past->bytes += kept->bytes;
    count_copy(past, wall_ms() - began, kept->bytes);
    return true;
}

static bool is_due(const Past *past, bool now)
{
    if (past->count > 0 && past->kept[past->count - 1]->place == past_last(past))
        return false;
    return now || past->count == 0 || is_time(past, past->kept[past->count - 1]->bytes);
}

void past_keep(Past *past, World *world, const Scene *scene, size_t next, bool now)
{
    if (!is_due(past, now) || !world_sound(world)) /* waits, so that the copy is timed alone */
        return;
    WorldInfo info;
    world_info(world, &info);
    past->state_bytes = bytes_of(info.count, &scene->world) + world_births_bytes(world);
    if (past->count == 0)
        forget_base(past);
    const size_t own = past->state_bytes + sizeof(Settings), whole = sizeof(Scene);
    const size_t needed = own + whole + past->place_count * sizeof *past->places;
    if (needed > past->bytes_most) { /* too large for even one state */
        past->dropped = true;
        return;
    }
    Kept *kept = make_room(past, own + (past->base ? 0 : whole));
    if (!kept)
        kept = calloc(1, sizeof *kept);
    if (!kept || !fill(past, kept, world, scene, next)) {
        kept_free(past, kept);
        return;
    }
    past->kept[past->count++] = kept;
    past->work_ms = 0;
    kept_free(past, make_room(past, 0)); /* in case the new state is larger than the previous one */
}

uint64_t past_find(const Past *past, double time)
{
    uint64_t low = past_first(past), high = past_last(past);
    while (low < high) {
        const uint64_t middle = low + (high - low + 1) / 2;
        if (past_place(past, middle).time <= time)
            low = middle;
        else
            high = middle - 1;
    }
    const bool failed = low == past_last(past) && low > past_first(past) &&
                        !(past_place(past, low - 1).time < past_place(past, low).time);
    return low - failed;
}

/* The last state at or before the place. */
static const Kept *kept_before(const Past *past, uint64_t place)
{
    size_t low = 0, high = past->count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (past->kept[middle]->place <= place)
            low = middle;
        else
            high = middle;
    }
    return past->kept[low];
}

uint64_t past_before(const Past *past, uint64_t place)
{
    return past->count > 0 ? kept_before(past, place)->place : past_last(past);
}

bool past_load(const Past *past, uint64_t place, World **world, Scene *scene, size_t *next, Error *error)
{
    Scene then;
    if (past->count == 0)
        return error_set(error, "no state of the past is kept");
    const Kept *kept = kept_before(past, place);
    settings_apply(past, kept->settings, &then);
    if (!world_load_shapes(world, &then.world, &kept->state, error))
        return false;
    memcpy(scene, &then, sizeof then); /* with padding, for comparisons */
    *next = kept->next;
    return true;
}

void past_cut(Past *past, uint64_t place)
{
    size_t states = past->count;
    while (states > 0 && past->kept[states - 1]->place > place)
        states--;
    forget_states(past, states);
    const size_t left = (size_t)(place - past->before) + 1;
    past->bytes -= (past->place_count - left) * sizeof *past->places;
    past->place_count = left;
    past->work_ms = PAST_GAP_MS; /* the frame time since the last state is unknown */
}

PastFigures past_figures(const Past *past)
{
    return (PastFigures){.bytes = past->bytes,
                         .bytes_most = past->bytes_most,
                         .state_bytes = past->state_bytes,
                         .states = past->count,
                         .dropped = past->dropped};
}
