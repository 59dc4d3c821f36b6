#include "app/beside/panel_title.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A property in which panels may differ. */
typedef struct Figure {
    const char *key;                                     /* key setting the property; "": none */
    void (*text)(const PanelFacts *facts, char out[64]); /* "": unknown */
} Figure;

static void count_text(const PanelFacts *facts, char out[64])
{
    snprintf(out, 64, "%zu particle%s", facts->particles, facts->particles == 1 ? "" : "s");
}

static void spacing_text(const PanelFacts *facts, char out[64])
{
    snprintf(out, 64, "spacing %.3g mm", 1e3 * facts->spacing);
}

static void method_text(const PanelFacts *facts, char out[64])
{
    snprintf(out, 64, "%s%s", facts->recorded ? "" : "method ", facts->recorded ? "" : facts->def->method);
}

static void step_text(const PanelFacts *facts, char out[64])
{
    const WorldDef *def = facts->def;
    if (facts->recorded)
        *out = 0;
    else if (def->step_mode == STEP_FIXED)
        snprintf(out, 64, "steps of %.3g ms", 1e3 * def->dt / def->substeps);
    else
        snprintf(out, 64, "steps by cfl");
}

/* The spacing is shown even if the name contains it: fills may have changed the value. */
static const Figure figures[] = {
    {"", count_text}, {"", spacing_text}, {"solver.method", method_text}, {"", step_text}};

/* True if one of the lines sets the key. */
static bool says(const char *lines, const char *key)
{
    const size_t length = strlen(key);
    for (const char *at = lines; at && *at; at += strcspn(at, "\n"), at += *at != 0)
        if (length > 0 && strncmp(at, key, length) == 0 && at[length] == '=')
            return true;
    return false;
}

static void add(Title *title, const char *words)
{
    const size_t used = strlen(title->figures);
    if (*words)
        snprintf(title->figures + used, TITLE_SIZE - used, "%s%s", used ? ", " : "", words);
}

/* Notes a file without a state for the time, or a stopped solver. */
static void add_end(Title *title, const PanelFacts *facts)
{
    const double slack = 1e-9 * fmax(fabs(facts->wanted), 1);
    char words[64] = "";
    if (facts->failed)
        snprintf(words, sizeof words, "stopped at %.4g s", facts->time);
    else if (facts->recorded && facts->wanted > facts->last + slack)
        snprintf(words, sizeof words, "ends at %.4g s", facts->last);
    else if (facts->recorded && facts->wanted < facts->first - slack)
        snprintf(words, sizeof words, "begins at %.4g s", facts->first);
    add(title, words);
}

void panel_title(const PanelFacts facts[], int count, int panel, const char *unnamed, Title *title)
{
    const PanelFacts *own = &facts[panel];
    snprintf(title->words, sizeof title->words, "%s", *own->words ? own->words : unnamed);
    *title->figures = 0;
    add_end(title, own);
    for (size_t f = 0; f < sizeof figures / sizeof *figures; f++) {
        char text[64], other[64];
        bool differs = false;
        figures[f].text(own, text);
        for (int i = 0; i < count; i++) {
            figures[f].text(&facts[i], other);
            differs |= *other && strcmp(text, other) != 0;
        }
        if (differs && !says(own->said, figures[f].key))
            add(title, text);
    }
}
