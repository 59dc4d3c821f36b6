#include "render/frame/effect.h"

#include "sim/gpu/gl.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

void effect_add(const Effect *effect, const char *after)
{
    int count = 0, place = 0;
    for (; effect_list[count]; count++) {
        if (effect_list[count] == effect)
            return;
        if (strcmp(effect_list[count]->name, after) == 0)
            place = count + 1;
    }
    assert(count < EFFECTS_MAX && place > 0);
    for (int i = count; i > place; i--)
        effect_list[i] = effect_list[i - 1];
    effect_list[place] = effect;
}

/* The first effect in the list with this state; -1: none. */
static int owner_of(const EffectState *of)
{
    for (int i = 0; of && effect_list[i]; i++)
        if (effect_list[i]->state == of)
            return i;
    return -1;
}

void *effect_state(const EffectStates *states, const EffectState *of)
{
    const int owner = owner_of(of);
    return owner < 0 ? NULL : states->state[owner];
}

bool effects_prepare(EffectStates *states, const Subject *subject, Error *error)
{
    for (int i = 0; effect_list[i]; i++) {
        const EffectState *of = effect_list[i]->state;
        if (owner_of(of) != i)
            continue;
        if (!states->state[i])
            states->state[i] = calloc(1, of->size);
        if (!states->state[i])
            return error_set(error, "out of memory for the effect %s", effect_list[i]->name);
        if (of->prepare && !of->prepare(states->state[i], subject, error))
            return false;
    }
    return true;
}

void effects_release(EffectStates *states, const Subject *subject)
{
    for (int i = 0; effect_list[i]; i++)
        if (states->state[i] && effect_list[i]->state->release)
            effect_list[i]->state->release(states->state[i], subject);
}

void effects_destroy(EffectStates *states)
{
    for (int i = 0; effect_list[i]; i++)
        if (states->state[i]) {
            effect_list[i]->state->destroy(states->state[i]);
            free(states->state[i]);
        }
    *states = (EffectStates){{NULL}};
}

void effects_want(const ViewDef *def, ParticleWants *wants)
{
    for (int i = 0; effect_list[i]; i++)
        if (effect_list[i]->want)
            effect_list[i]->want(def, wants);
}

/* Ends the stage `open` and begins `next`, unless both are the same; STAGE_COUNT: none. */
static void change_stage(GlTimer *timer, Stage *open, Stage next)
{
    if (*open == next)
        return;
    if (*open != STAGE_COUNT)
        gl_timer_end(timer, *open);
    if (next != STAGE_COUNT)
        gl_timer_begin(timer);
    *open = next;
}

static bool wanted(const Effect *effect, const Picture *picture)
{
    return !effect->wanted || effect->wanted(picture);
}

void effects_draw(Picture *picture)
{
    Stage open = STAGE_COUNT;
    for (int i = 0; effect_list[i] != &effect_enlarge; i++) {
        const Effect *effect = effect_list[i];
        if (!wanted(effect, picture))
            continue;
        assert(effect->stage == STAGE_COUNT || stage_part(effect->stage) == PART_RENDER);
        change_stage(picture->frame.timer, &open, effect->stage);
        effect->draw(effect_state(picture->states, effect->state), picture);
    }
    change_stage(picture->frame.timer, &open, STAGE_COUNT);
}

void effects_draw_whole(Picture *picture)
{
    bool whole = false;
    for (int i = 0; effect_list[i]; i++) {
        const Effect *effect = effect_list[i];
        whole = whole || effect == &effect_enlarge;
        if (whole && wanted(effect, picture))
            effect->draw(effect_state(picture->states, effect->state), picture);
    }
}
