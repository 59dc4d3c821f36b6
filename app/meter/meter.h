/* What the live window measures of itself: pictures a second, the time from start to the first picture, and
   from an event to the first picture that shows it. Pure but for the clocks of the process. */
#ifndef SLOSH_PLAY_METER_H
#define SLOSH_PLAY_METER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { METER_HISTORY = 120, METER_WAITING_MAX = 256, METER_SAMPLES_MAX = 1 << 14 };

/* An event that became a command: when it came, and the command's number. */
typedef struct MeterEvent {
    double when_ms;
    uint64_t command;
} MeterEvent;

/* Zero-initialise it. Times are wall_ms(). */
typedef struct PlayMeter {
    double first_ms;              /* from the start of the process to the first picture; 0: none yet */
    double last_ms;               /* wall time of the last picture */
    size_t pictures;              /* in all */
    double second_began_ms;       /* of the present count */
    int in_second;                /* pictures since then */
    double pictures_per_second;   /* of the last second */
    float history[METER_HISTORY]; /* from picture to picture, ms; a ring; without pauses */
    bool rests;                   /* as of meter_rest */
    int history_next, history_count;
    int waiting_count;
    MeterEvent waiting[METER_WAITING_MAX]; /* not shown yet, in the order of their commands */
    size_t latencies;                      /* shown, in all */
    float latency_ms[METER_SAMPLES_MAX];   /* of the last of them; a ring */
    double began_ms, began_cpu_ms;  /* wall and CPU time of the first picture of a state; 0: none yet */
    double drawn_ms, last_drawn_ms; /* wall time of drawing: all pictures; the last one */
    double panel_ms;                /* CPU time of the panel in all of them */
    double events_ms;               /* CPU time of taking events, in all */
    size_t drawn, panels;           /* how many these were */
} PlayMeter;

/* Wall time since the process began, ms; its own start included. 0 where /proc does not tell. */
double meter_process_age_ms(void);

/* An event at `when_ms` became that command. */
void meter_event(PlayMeter *meter, double when_ms, uint64_t command);

/* A picture is on the screen now, of a state that has obeyed `obeyed` commands. */
void meter_picture(PlayMeter *meter, double now_ms, uint64_t obeyed);

/* The time is paused, or not: pictures come then as somebody does something, which is no rate. */
void meter_rest(PlayMeter *meter, bool rests);

/* The first picture of a state: from now on the session counts. False: it was not the first. */
bool meter_begin(PlayMeter *meter, double now_ms);

/* CPU time of the process; of the calling thread, ms. */
double meter_cpu_ms(void);
double meter_thread_cpu_ms(void);

/* What a picture took; what of it the panel took, CPU time; means over all. */
void meter_drawn(PlayMeter *meter, double ms);
void meter_panel(PlayMeter *meter, double cpu_ms);
double meter_drawn_mean(const PlayMeter *meter);
double meter_panel_mean(const PlayMeter *meter);

/* CPU time of taking events, between pictures and in them; for a picture, mean. */
void meter_events(PlayMeter *meter, double cpu_ms);
double meter_events_mean(const PlayMeter *meter);

/* The picture-to-picture times, oldest first; how many. */
int meter_history(const PlayMeter *meter, float out[METER_HISTORY]);

/* The value that `fraction` of the latencies do not exceed, ms; 0 without any. */
double meter_latency(const PlayMeter *meter, double fraction);

/* Forgets what waits: another scene counts its commands anew. */
void meter_forget(PlayMeter *meter);

#endif
