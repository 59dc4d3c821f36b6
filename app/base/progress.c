#include "app/base/progress.h"

#include "sim/base/stage.h"

#include <math.h>
#include <stdbool.h>
#include <unistd.h>

enum { BAR_WIDTH = 30 };
static const double REDRAW_MS = 100; /* often enough to look alive, and seldom enough to cost nothing */

void progress_begin(Progress *progress, FILE *stream, const char *what, bool quiet)
{
    *progress = (Progress){.stream = quiet ? NULL : stream, .what = what, .began_ms = wall_ms()};
    progress->terminal = !quiet && isatty(fileno(stream));
    progress->drawn_ms = progress->began_ms - REDRAW_MS;
}

/* Prints 0:07, 12:30, 1:02:03. */
static void print_duration(FILE *stream, double seconds)
{
    long s = lround(seconds);
    if (s >= 3600)
        fprintf(stream, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    else
        fprintf(stream, "%ld:%02ld", s / 60, s % 60);
}

static void print_state(const Progress *progress, double fraction, double elapsed)
{
    fprintf(progress->stream, "%3.0f %%  ", floor(100 * fraction));
    print_duration(progress->stream, elapsed);
    fprintf(progress->stream, " elapsed");
    if (fraction > 0 && fraction < 1) {
        fprintf(progress->stream, ", about ");
        print_duration(progress->stream, elapsed * (1 - fraction) / fraction);
        fprintf(progress->stream, " left");
    }
}

static void draw_bar(Progress *progress, double fraction, double now_ms)
{
    char bar[BAR_WIDTH + 1];
    for (int i = 0; i < BAR_WIDTH; i++)
        bar[i] = i < fraction * BAR_WIDTH ? '#' : '-';
    bar[BAR_WIDTH] = '\0';
    fprintf(progress->stream, "\r%s [%s] ", progress->what, bar);
    print_state(progress, fraction, (now_ms - progress->began_ms) / 1000);
    fprintf(progress->stream, "\033[K");
    fflush(progress->stream);
    progress->drawn = true;
    progress->drawn_ms = now_ms;
}

void progress_update(Progress *progress, double fraction)
{
    double now_ms = wall_ms();
    if (!progress->stream)
        return;
    fraction = fmin(fmax(fraction, 0), 1);
    if (progress->terminal) {
        if (now_ms - progress->drawn_ms >= REDRAW_MS)
            draw_bar(progress, fraction, now_ms);
    } else if ((int)(10 * fraction) > progress->tenth) {
        progress->tenth = (int)(10 * fraction);
        fprintf(progress->stream, "%s: ", progress->what);
        print_state(progress, fraction, (now_ms - progress->began_ms) / 1000);
        fputc('\n', progress->stream);
    }
}

void progress_end(Progress *progress)
{
    if (progress->drawn)
        fprintf(progress->stream, "\r\033[K");
    progress->drawn = false;
}
