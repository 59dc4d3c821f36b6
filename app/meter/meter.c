#include "app/meter/meter.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Reads field 22 of /proc/self/stat, in clock ticks since system start; the second field, in parentheses,
   may contain any characters. */
double meter_process_age_ms(void)
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

void meter_event(PlayMeter *meter, double when_ms, uint64_t command)
{
    if (meter->waiting_count < METER_WAITING_MAX)
        meter->waiting[meter->waiting_count++] = (MeterEvent){when_ms, command};
}

static void show_events(PlayMeter *meter, double now_ms, uint64_t obeyed)
{
    int shown = 0;
    while (shown < meter->waiting_count && meter->waiting[shown].command <= obeyed) {
        meter->latency_ms[meter->latencies++ % METER_SAMPLES_MAX] =
            (float)(now_ms - meter->waiting[shown].when_ms);
        shown++;
    }
    meter->waiting_count -= shown;
    memmove(meter->waiting, meter->waiting + shown, sizeof *meter->waiting * (size_t)meter->waiting_count);
}

void meter_picture(PlayMeter *meter, double now_ms, uint64_t obeyed)
{
    if (meter->pictures++ == 0) {
        meter->first_ms = meter_process_age_ms();
        meter->second_began_ms = now_ms;
    } else if (meter->rests) {
        meter->second_began_ms = now_ms;
        meter->in_second = 0;
    } else {
        meter->history[meter->history_next] = (float)(now_ms - meter->last_ms);
        meter->history_next = (meter->history_next + 1) % METER_HISTORY;
        meter->history_count += meter->history_count < METER_HISTORY;
        meter->in_second++;
    }
    meter->last_ms = now_ms;
    if (now_ms - meter->second_began_ms >= 1000) {
        meter->pictures_per_second = 1000 * meter->in_second / (now_ms - meter->second_began_ms);
        meter->second_began_ms = now_ms;
        meter->in_second = 0;
    }
    show_events(meter, now_ms, obeyed);
}

static double clock_ms(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

double meter_cpu_ms(void)
{
    return clock_ms(CLOCK_PROCESS_CPUTIME_ID);
}

double meter_thread_cpu_ms(void)
{
    return clock_ms(CLOCK_THREAD_CPUTIME_ID);
}

/* The first picture after a pause ends the pause. */
void meter_rest(PlayMeter *meter, bool rests)
{
    meter->rests = rests;
}

bool meter_begin(PlayMeter *meter, double now_ms)
{
    if (meter->began_ms > 0)
        return false;
    meter->began_ms = now_ms;
    meter->began_cpu_ms = meter_cpu_ms();
    return true;
}

void meter_drawn(PlayMeter *meter, double ms)
{
    meter->last_drawn_ms = ms;
    meter->drawn_ms += ms;
    meter->drawn++;
}

void meter_panel(PlayMeter *meter, double cpu_ms)
{
    meter->panel_ms += cpu_ms;
    meter->panels++;
}

double meter_drawn_mean(const PlayMeter *meter)
{
    return meter->drawn ? meter->drawn_ms / (double)meter->drawn : 0;
}

double meter_panel_mean(const PlayMeter *meter)
{
    return meter->panels ? meter->panel_ms / (double)meter->panels : 0;
}

void meter_events(PlayMeter *meter, double cpu_ms)
{
    meter->events_ms += cpu_ms;
}

double meter_events_mean(const PlayMeter *meter)
{
    return meter->drawn ? meter->events_ms / (double)meter->drawn : 0;
}

int meter_history(const PlayMeter *meter, float out[METER_HISTORY])
{
    for (int i = 0; i < meter->history_count; i++)
        out[i] =
            meter->history[(meter->history_next - meter->history_count + i + METER_HISTORY) % METER_HISTORY];
    return meter->history_count;
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

double meter_latency(const PlayMeter *meter, double fraction)
{
    const size_t count = meter->latencies < METER_SAMPLES_MAX ? meter->latencies : METER_SAMPLES_MAX;
    float *sorted = count ? malloc(count * sizeof *sorted) : NULL;
    if (!sorted)
        return 0;
    memcpy(sorted, meter->latency_ms, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, ascending);
    const double latency = sorted[(size_t)(fraction * (double)(count - 1))];
    free(sorted);
    return latency;
}

void meter_forget(PlayMeter *meter)
{
    meter->waiting_count = 0;
}
