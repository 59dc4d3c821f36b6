#include "render/frame/effect.h"
#include "render/frame/view.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

size_t overlay_own_offset(int index)
{
    int views = 0;
    while (view_at(views))
        views++;
    size_t offset = view_own_offset(views);
    for (int i = 0; i < index; i++)
        offset += (overlay_list[i]->def_size + 7) / 8 * 8;
    return offset;
}

void *overlay_own_settings(const ViewDef *def, const OverlayKind *kind)
{
    for (int i = 0; overlay_list[i]; i++)
        if (overlay_list[i] == kind)
            return (void *)(def->own.bytes + overlay_own_offset(i));
    return NULL;
}

static bool shown(const ViewDef *def, int index)
{
    return ((const OverlayShow *)(const void *)(def->own.bytes + overlay_own_offset(index)))->show;
}

void overlays_default(ViewDef *def)
{
    for (int i = 0; overlay_list[i]; i++) {
        assert(i < OVERLAY_KINDS_MAX && overlay_own_offset(i + 1) <= VIEW_OWN_SIZE);
        memcpy(def->own.bytes + overlay_own_offset(i), overlay_list[i]->def, overlay_list[i]->def_size);
    }
}

void overlays_want(const ViewDef *def, ParticleWants *wants)
{
    for (int i = 0; overlay_list[i]; i++)
        if (!def || shown(def, i))
            overlay_list[i]->wants(def, wants);
}

double overlays_every(const ViewDef *def, double *before)
{
    double least = INFINITY;
    *before = 0;
    for (int i = 0; overlay_list[i]; i++) {
        double own = 0;
        if (!shown(def, i) || !overlay_list[i]->every)
            continue;
        least = fmin(least, overlay_list[i]->every(def, &own));
        *before = fmax(*before, own);
    }
    return least;
}

bool overlays_check(const Subject *subject, const char **key, Error *error)
{
    for (int i = 0; overlay_list[i]; i++)
        if (shown(subject->def, i) && overlay_list[i]->check && !overlay_list[i]->check(subject, key, error))
            return false;
    return true;
}

/* Creates the overlays that are newly shown. */
static bool make(const Overlays *overlays, const Subject *subject, void *made[], Error *error)
{
    for (int i = 0; overlay_list[i]; i++)
        if (shown(subject->def, i) && !overlays->state[i] &&
            !(made[i] = overlay_list[i]->create(subject, error)))
            return false;
    return true;
}

bool overlays_update(Overlays *overlays, const Subject *subject, Error *error)
{
    void *made[OVERLAY_KINDS_MAX] = {NULL};
    const bool ok = make(overlays, subject, made, error);
    for (int i = 0; overlay_list[i]; i++) {
        void **state = &overlays->state[i], *gone = ok ? NULL : made[i];
        if (ok && made[i]) {
            *state = made[i];
            overlays->taken[i] = false;
        } else if (ok && *state && !shown(subject->def, i)) {
            gone = *state;
            *state = NULL;
        }
        if (gone)
            overlay_list[i]->destroy(gone);
    }
    return ok;
}

void overlays_destroy(Overlays *overlays)
{
    for (int i = 0; overlay_list[i]; i++)
        if (overlays->state[i])
            overlay_list[i]->destroy(overlays->state[i]);
    *overlays = (Overlays){0};
}

bool overlays_keep_states(const Overlays *overlays)
{
    bool any = false;
    for (int i = 0; overlay_list[i]; i++)
        any |= overlays->state[i] && overlay_list[i]->take;
    return any;
}

void overlays_add_state(Overlays *overlays, const ParticleBuffers *particles, const Subject *subject,
                        GlTimer *timer)
{
    const bool same = overlays->step == particles->step && overlays->time == particles->time &&
                      overlays->count == particles->count;
    for (int i = 0; overlay_list[i]; i++) {
        if (!overlays->state[i] || !overlay_list[i]->take || (same && overlays->taken[i]))
            continue;
        overlay_list[i]->take(overlays->state[i], particles, subject, timer);
        overlays->taken[i] = true;
    }
    overlays->step = particles->step;
    overlays->time = particles->time;
    overlays->count = particles->count;
}

bool overlays_any(const Overlays *overlays)
{
    bool any = false;
    for (int i = 0; overlay_list[i]; i++)
        any |= overlays->state[i] != NULL;
    return any;
}

void overlays_draw(const Overlays *overlays, const ParticleBuffers *particles, const Frame *frame)
{
    for (int i = 0; overlay_list[i]; i++)
        if (overlays->state[i])
            overlay_list[i]->draw(overlays->state[i], particles, frame);
}

bool overlays_unfinished(const Overlays *overlays)
{
    bool any = false;
    for (int i = 0; overlay_list[i]; i++)
        any |= overlays->state[i] && overlay_list[i]->unfinished &&
               overlay_list[i]->unfinished(overlays->state[i]);
    return any;
}

int overlays_choose(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX], char words[160])
{
    for (int i = 0; overlay_list[i]; i++)
        if (overlay_list[i]->choose)
            return overlay_list[i]->choose(def, id, settings, words);
    snprintf(words, 160, "no overlay follows particles");
    return 0;
}

int overlays_legend(const Overlays *overlays, const Frame *frame, OverlayLine lines[OVERLAY_KINDS_MAX])
{
    int count = 0;
    for (int i = 0; overlay_list[i]; i++) {
        char *line = lines[count].words;
        *line = 0;
        if (overlays->state[i] && frame->flat && count == 0)
            snprintf(line, sizeof lines->words, "no overlays on a flat slice");
        else if (overlays->state[i] && !frame->flat && overlay_list[i]->legend)
            overlay_list[i]->legend(overlays->state[i], frame, line, sizeof lines->words);
        count += *line != 0;
    }
    return count;
}

bool overlays_wanted(const Overlays *overlays, const Frame *frame)
{
    return overlays_any(overlays) && !frame->flat && !(frame->slab > 0);
}

static bool wanted(const Picture *picture)
{
    return overlays_wanted(picture->overlays, &picture->frame);
}

/* In a two-dimensional scene overlays lie over everything. */
static bool wanted_flat(const Picture *picture)
{
    return overlays_any(picture->overlays) && !picture->frame.flat && picture->frame.slab > 0;
}

static void draw(void *state, Picture *picture)
{
    (void)state;
    overlays_draw(picture->overlays, picture->particles, &picture->frame);
}

const Effect effect_overlays = {
    .name = "overlays", .stage = STAGE_COUNT, .want = overlays_want, .wanted = wanted, .draw = draw};

const Effect effect_overlays_flat = {
    .name = "overlays_flat", .stage = STAGE_COUNT, .wanted = wanted_flat, .draw = draw};
