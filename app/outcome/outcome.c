#include "app/outcome/outcome.h"

#include "app/base/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* X(ENUM, word, help) */
static const char *const words[OUTCOME_COUNT] = {
#define X(NAME, word, help) word,
    OUTCOMES(X)
#undef X
};

const char *outcome_word(OutcomeKind kind)
{
    return words[kind];
}

const char *outcome_help(OutcomeKind kind)
{
    static const char *const helps[OUTCOME_COUNT] = {
#define X(NAME, word, help) help,
        OUTCOMES(X)
#undef X
    };
    return helps[kind];
}

OutcomeKind outcome_of_word(const char *word)
{
    int kind = 0;
    while (kind < OUTCOME_COUNT && strcmp(words[kind], word) != 0)
        kind++;
    return (OutcomeKind)kind;
}

/* Replaces line ends, as a table row has one line. */
static void put_on_one_line(char text[OUTCOME_WORDS])
{
    for (char *at = text; *at; at++)
        *at = *at == '\n' ? ' ' : *at;
}

static const OutcomeKind of_trouble[STEP_TROUBLE_COUNT] = {
    [STEP_TROUBLE_NONE] = OUTCOME_NONE,      [STEP_TROUBLE_SPEED] = OUTCOME_BLOWN_UP,
    [STEP_TROUBLE_SOLID] = OUTCOME_BLOWN_UP, [STEP_TROUBLE_DENSITY] = OUTCOME_BLOWN_UP,
    [STEP_TROUBLE_ENERGY] = OUTCOME_NOISY,   [STEP_TROUBLE_SOLVE] = OUTCOME_DIVERGES,
    [STEP_TROUBLE_MEMORY] = OUTCOME_NONE,    [STEP_TROUBLE_LOST] = OUTCOME_LEAKS};

/* Sets a worse kind; an equally bad kind at a later time is ignored. */
static void find(Outcome *outcome, OutcomeKind kind, double time)
{
    if (kind > outcome->kind) {
        outcome->kind = kind;
        outcome->time = time;
        outcome->words[0] = '\0';
    }
}

static void judge_energy(const OutcomeHistory *history, Outcome *outcome)
{
    double least = INFINITY;
    for (int i = 0; i < history->count && outcome->kind < OUTCOME_NOISY; i++) {
        const OutcomeLook *look = &history->look[i];
        const double gain = (look->energy - least) / look->scale; /* false for NaN */
        if (gain > OUTCOME_GAIN) {
            find(outcome, OUTCOME_NOISY, look->time);
            snprintf(outcome->words, OUTCOME_WORDS, "%s: %.3g %%", outcome_help(OUTCOME_NOISY), 100 * gain);
        }
        least = fmin(least, look->energy);
    }
}

static void judge_motion(const OutcomeLook *look, Outcome *outcome)
{
    if (look->sound > 0 && look->fastest > look->sound && outcome->kind < OUTCOME_FAST) {
        find(outcome, OUTCOME_FAST, look->time);
        snprintf(outcome->words, OUTCOME_WORDS, "a particle moves at %.4g m/s, and sound at %g m/s",
                 look->fastest, look->sound);
    }
    if (look->jump > 1 && look->together < OUTCOME_TOGETHER && outcome->kind < OUTCOME_BOILS) {
        find(outcome, OUTCOME_BOILS, look->time);
        snprintf(outcome->words, OUTCOME_WORDS, "%s: %.3g %% of their energy of motion",
                 outcome_help(OUTCOME_BOILS), 100 * (1 - look->together));
    }
}

static double part(size_t some, const OutcomeLook *look)
{
    return look->count > 0 ? (double)some / (double)look->count : 0;
}

static void judge_volume(const OutcomeLook *look, Outcome *outcome)
{
    if (!(look->pressed > OUTCOME_PRESSED) || outcome->kind >= OUTCOME_SQUEEZED)
        return;
    find(outcome, OUTCOME_SQUEEZED, look->time);
    snprintf(outcome->words, OUTCOME_WORDS, "%s: it is pressed by %.3g %% in the mean",
             outcome_help(OUTCOME_SQUEEZED), 100 * look->pressed);
}

/* Close particles at the start, such as emitted fluid or a jittered lattice, are no clumps. */
static void judge_places(const OutcomeHistory *history, int i, Outcome *outcome)
{
    const OutcomeLook *look = &history->look[i], *first = &history->look[0];
    const double close = part(look->close, look), out = part(look->beyond + look->lost, look);
    if (close - part(first->close, first) > OUTCOME_CLOSE && outcome->kind < OUTCOME_CLUMPS) {
        find(outcome, OUTCOME_CLUMPS, look->time);
        snprintf(outcome->words, OUTCOME_WORDS,
                 "%.3g %% of the particles are nearer than %g spacings to another", 100 * close,
                 OUTCOME_NEAR);
    }
    if (out > OUTCOME_OUT && outcome->kind < OUTCOME_LEAKS) {
        find(outcome, OUTCOME_LEAKS, look->time);
        if (look->beyond >= look->lost)
            snprintf(outcome->words, OUTCOME_WORDS, "%zu of %zu particles are beyond a wall", look->beyond,
                     look->count);
        else
            snprintf(outcome->words, OUTCOME_WORDS, "%zu of %zu particles have no place in the grid",
                     look->lost, look->count);
    }
    if (look->stuck && outcome->kind < OUTCOME_DIVERGES) {
        find(outcome, OUTCOME_DIVERGES, look->time);
        snprintf(outcome->words, OUTCOME_WORDS, "%s", step_trouble_words(STEP_TROUBLE_SOLVE));
    }
}

/* The trouble that ended a run decides its kind, whatever was found before. */
static void judge_end(const WorldTrouble *trouble, Outcome *outcome)
{
    char found[160];
    *outcome = (Outcome){.kind = of_trouble[trouble->what], .time = trouble->time};
    world_trouble_words(trouble, found);
    snprintf(outcome->words, OUTCOME_WORDS, "%s", found);
}

void outcome_judge(const OutcomeHistory *history, Outcome *outcome)
{
    *outcome = (Outcome){.kind = OUTCOME_HOLDS, .time = (double)NAN};
    if (history->trouble.ended) {
        judge_end(&history->trouble, outcome);
    } else {
        judge_energy(history, outcome);
        for (int i = 0; i < history->count; i++) {
            judge_motion(&history->look[i], outcome);
            judge_volume(&history->look[i], outcome);
            judge_places(history, i, outcome);
        }
    }
    put_on_one_line(outcome->words);
}

void outcome_not_run(const char *why, Outcome *outcome)
{
    *outcome = (Outcome){.kind = OUTCOME_NONE, .time = (double)NAN};
    snprintf(outcome->words, OUTCOME_WORDS, "%.*s", OUTCOME_WORDS - 1, why);
    put_on_one_line(outcome->words);
}

const char *outcome_text(const Outcome *outcome, char text[OUTCOME_TEXT])
{
    char time[32] = "";
    if (isfinite(outcome->time))
        snprintf(time, sizeof time, " at t = %.4g s", outcome->time);
    snprintf(text, OUTCOME_TEXT, "%s%s%s%s", outcome_word(outcome->kind), time, *outcome->words ? ": " : "",
             outcome->words);
    return text;
}

void outcome_json(json_t *object, const Outcome *outcome)
{
    if (!object)
        return;
    json_object_set_new(object, "outcome", json_string(outcome_word(outcome->kind)));
    if (outcome->kind == OUTCOME_HOLDS)
        return;
    json_object_set_new(object, "outcome_time", number_json(outcome->time));
    json_object_set_new(object, "outcome_words", json_string(outcome->words));
}
