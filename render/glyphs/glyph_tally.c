#include "render/glyphs/glyph_tally.h"

#include <math.h>
#include <string.h>

bool glyph_tallies_create(GlyphTallies *tallies, Error *error)
{
    return mailbox_create(&tallies->box, "glyphs' command",
                          sizeof(uint32_t[GLYPH_COMMAND_WORDS]) + sizeof(GlyphTally)) ||
           error_set(error, "the GPU has no memory for glyphs");
}

void glyph_tallies_destroy(GlyphTallies *tallies)
{
    mailbox_destroy(&tallies->box);
    *tallies = (GlyphTallies){0};
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* True if both give the same arrows. */
static bool same_def(const GlyphsDef *a, const GlyphsDef *b)
{
    return a->vector == b->vector && a->at == b->at && a->stride == b->stride && a->cell == b->cell &&
           same3(a->plane_point, b->plane_point) && same3(a->plane_normal, b->plane_normal);
}

static bool same(const GlyphTallyOf *a, const GlyphTallyOf *b)
{
    return a->step == b->step && a->time == b->time && a->count == b->count &&
           a->vectors.buffer == b->vectors.buffer && a->vectors.offset == b->vectors.offset &&
           same_def(&a->def, &b->def);
}

/* Takes an answer; NULL: none will come, since the context is lost. */
static void take(GlyphTallies *tallies, const void *came)
{
    tallies->tally = (GlyphTally){{0}, 0};
    if (came)
        memcpy(&tallies->tally, (const uint32_t *)came + GLYPH_COMMAND_WORDS, sizeof tallies->tally);
    tallies->of = tallies->asked;
    tallies->known = true;
}

static void look(GlyphTallies *tallies)
{
    const bool under_way = tallies->box.fence != NULL;
    const void *came = mailbox_look(&tallies->box);
    if (under_way && !tallies->box.fence)
        take(tallies, came);
}

const GlyphTally *glyph_tallies_follow(GlyphTallies *tallies, const ParticleBuffers *particles,
                                       const Frame *frame)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    const GlyphTallyOf now = {particles->step, particles->time, particles->count,
                              particles->vector[def->vector], *def};
    const bool waits = !frame->behind || !tallies->known || tallies->of.def.vector != def->vector;
    look(tallies);
    if (waits || (!tallies->box.fence && !same(&tallies->of, &now))) {
        mailbox_send(&tallies->box);
        tallies->asked = now;
    }
    if (waits)
        take(tallies, mailbox_wait(&tallies->box));
    else
        *frame->behind |= !same(&tallies->of, &now);
    return &tallies->tally;
}

static double round_up(double x)
{
    static const double rounds[] = {1, 1.5, 2, 3, 5, 7};
    const double power = pow(10, floor(log10(x)));
    for (size_t i = 0; i < sizeof rounds / sizeof *rounds; i++)
        if (x <= 1.0001 * rounds[i] * power)
            return rounds[i] * power;
    return 10 * power;
}

double glyph_usual(const GlyphTally *tally)
{
    uint64_t all = 0, below = 0;
    int bin = 0;
    for (int i = 0; i < GLYPH_BINS; i++)
        all += tally->bins[i];
    for (; bin < GLYPH_BINS && 20 * below < 19 * all; bin++)
        below += tally->bins[bin];
    return all > 0 ? round_up(exp2((bin - 0.5 * GLYPH_BINS) / GLYPH_OCTAVE_BINS)) : 0;
}
