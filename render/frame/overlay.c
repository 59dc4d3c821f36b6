#include "render/frame/passes.h"
#include "render/frame/view.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

void *overlay_own_settings(const ViewDef *def, const OverlayKind *kind)
{
    for (int i = 0; overlay_list[i]; i++)
        if (overlay_list[i] == kind)
            return (void *)def->of_overlay[i].bytes;
    return NULL;
}

static bool shown(const ViewDef *def, int index)
{
    return ((const OverlayShow *)(const void *)def->of_overlay[index].bytes)->show;
}

void overlays_default(ViewDef *def)
{
    for (int i = 0; overlay_list[i]; i++) {
        assert(i < OVERLAY_KINDS_MAX && overlay_list[i]->def_size <= VIEW_OWN_SIZE);
        memcpy(def->of_overlay[i].bytes, overlay_list[i]->def, overlay_list[i]->def_size);
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

void overlays_legend(const Overlays *overlays, Text *text, const Frame *frame)
{
    const float em = text_height(text);
    int lines = 0;
    for (int i = 0; overlay_list[i]; i++) {
        char line[160] = "";
        if (overlays->state[i] && frame->flat && lines == 0)
            snprintf(line, sizeof line, "no overlays on a flat slice");
        else if (overlays->state[i] && !frame->flat && overlay_list[i]->legend)
            overlay_list[i]->legend(overlays->state[i], frame, line, sizeof line);
        if (*line)
            legend_line(text, frame, em, (float)frame->height - (3.6F + 1.6F * (float)lines++) * em, line);
    }
}
