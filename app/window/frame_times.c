#include "app/window/window.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Reads field 22 of /proc/self/stat, in clock ticks since system start; the second field, in parentheses,
   may contain any characters. */
double process_age_ms(void)
{
    char text[1024];
    unsigned long long ticks = 0;
    struct timespec now;
    FILE *file = fopen("/proc/self/stat", "r");
    const size_t size = file ? fread(text, 1, sizeof text - 1, file) : 0;
    if (file)
        fclose(file);
    text[size] = 0;
    char *field = strrchr(text, ')');
    for (int i = 2; field && i < 22; i++)
        field = strchr(field + 1, ' ');
    if (!field || clock_gettime(CLOCK_BOOTTIME, &now) != 0)
        return 0;
    ticks = strtoull(field, NULL, 10);
    return 1e3 * ((double)now.tv_sec - (double)ticks / (double)sysconf(_SC_CLK_TCK)) +
           1e-6 * (double)now.tv_nsec;
}

void frame_times_event(FrameTimes *frame_times, double when_ms, uint64_t command)
{
    if (frame_times->waiting_count < FRAME_TIMES_WAITING_MAX)
        frame_times->waiting[frame_times->waiting_count++] = (FrameEvent){when_ms, command};
}

static void show_events(FrameTimes *frame_times, double now_ms, uint64_t applied)
{
    int shown = 0;
    while (shown < frame_times->waiting_count && frame_times->waiting[shown].command <= applied) {
        frame_times->latency_ms[frame_times->latencies++ % FRAME_TIMES_SAMPLES_MAX] =
            (float)(now_ms - frame_times->waiting[shown].when_ms);
        shown++;
    }
    frame_times->waiting_count -= shown;
    memmove(frame_times->waiting, frame_times->waiting + shown,
            sizeof *frame_times->waiting * (size_t)frame_times->waiting_count);
}

void frame_times_picture(FrameTimes *frame_times, double now_ms, uint64_t applied)
{
    if (frame_times->pictures++ == 0) {
        frame_times->first_ms = process_age_ms();
        frame_times->second_began_ms = now_ms;
    } else if (frame_times->rests) {
        frame_times->second_began_ms = now_ms;
        frame_times->in_second = 0;
    } else {
        frame_times->history[frame_times->history_next] = (float)(now_ms - frame_times->last_ms);
        frame_times->history_next = (frame_times->history_next + 1) % FRAME_TIMES_HISTORY;
        frame_times->history_count += frame_times->history_count < FRAME_TIMES_HISTORY;
        frame_times->in_second++;
    }
    frame_times->last_ms = now_ms;
    if (now_ms - frame_times->second_began_ms >= 1000) {
        frame_times->pictures_per_second =
            1000 * frame_times->in_second / (now_ms - frame_times->second_began_ms);
        frame_times->second_began_ms = now_ms;
        frame_times->in_second = 0;
    }
    show_events(frame_times, now_ms, applied);
}

static double clock_ms(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

double process_cpu_ms(void)
{
    return clock_ms(CLOCK_PROCESS_CPUTIME_ID);
}

double thread_cpu_ms(void)
{
    return clock_ms(CLOCK_THREAD_CPUTIME_ID);
}

/* The first picture after a pause ends the pause. */
void frame_times_pause(FrameTimes *frame_times, bool rests)
{
    frame_times->rests = rests;
}

bool frame_times_begin(FrameTimes *frame_times, double now_ms)
{
    if (frame_times->began_ms > 0)
        return false;
    frame_times->began_ms = now_ms;
    frame_times->began_cpu_ms = process_cpu_ms();
    return true;
}

void frame_times_drawn(FrameTimes *frame_times, double ms)
{
    frame_times->last_drawn_ms = ms;
    frame_times->drawn_ms += ms;
    frame_times->drawn++;
}

void frame_times_panel(FrameTimes *frame_times, double cpu_ms)
{
    frame_times->panel_ms += cpu_ms;
    frame_times->panels++;
}

double frame_times_drawn_mean(const FrameTimes *frame_times)
{
    return frame_times->drawn ? frame_times->drawn_ms / (double)frame_times->drawn : 0;
}

double frame_times_panel_mean(const FrameTimes *frame_times)
{
    return frame_times->panels ? frame_times->panel_ms / (double)frame_times->panels : 0;
}

void frame_times_events(FrameTimes *frame_times, double cpu_ms)
{
    frame_times->events_ms += cpu_ms;
}

double frame_times_events_mean(const FrameTimes *frame_times)
{
    return frame_times->drawn ? frame_times->events_ms / (double)frame_times->drawn : 0;
}

int frame_times_history(const FrameTimes *frame_times, float out[FRAME_TIMES_HISTORY])
{
    for (int i = 0; i < frame_times->history_count; i++)
        out[i] =
            frame_times
                ->history[(frame_times->history_next - frame_times->history_count + i + FRAME_TIMES_HISTORY) %
                          FRAME_TIMES_HISTORY];
    return frame_times->history_count;
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

double frame_times_latency(const FrameTimes *frame_times, double fraction)
{
    const size_t count =
        frame_times->latencies < FRAME_TIMES_SAMPLES_MAX ? frame_times->latencies : FRAME_TIMES_SAMPLES_MAX;
    float *sorted = count ? malloc(count * sizeof *sorted) : NULL;
    if (!sorted)
        return 0;
    memcpy(sorted, frame_times->latency_ms, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, ascending);
    const double latency = sorted[(size_t)(fraction * (double)(count - 1))];
    free(sorted);
    return latency;
}

void frame_times_forget_events(FrameTimes *frame_times)
{
    frame_times->waiting_count = 0;
}
