/* Measurements of the live window: pictures per second, time from start to the first picture, and delay
   from an event to the first picture showing its effect. Pure, except for the clocks of the process. */
#ifndef SLOSH_PLAY_METER_H
#define SLOSH_PLAY_METER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { METER_HISTORY = 120, METER_WAITING_MAX = 256, METER_SAMPLES_MAX = 1 << 14 };

/* An event turned into a command: time of the event, number of the command. */
typedef struct MeterEvent {
    double when_ms;
    uint64_t command;
} MeterEvent;

/* Zero-initialise before use. Times are wall_ms(). */
typedef struct PlayMeter {
    double first_ms;              /* from process start to the first picture; 0: none yet */
    double last_ms;               /* wall time of the last picture */
    size_t pictures;              /* total */
    double second_began_ms;       /* of the present count */
    int in_second;                /* pictures in that second */
    double pictures_per_second;   /* of the last second */
    float history[METER_HISTORY]; /* times between pictures, ms, without pauses; ring buffer */
    bool rests;                   /* set by meter_rest */
    int history_next, history_count;
    int waiting_count;
    MeterEvent waiting[METER_WAITING_MAX]; /* not shown yet, ordered by command */
    size_t latencies;                      /* count of shown events */
    float latency_ms[METER_SAMPLES_MAX];   /* latencies of the last events; ring buffer */
    double began_ms, began_cpu_ms;  /* wall and CPU time of the first picture of a state; 0: none yet */
    double drawn_ms, last_drawn_ms; /* wall time of drawing: total; last picture */
    double panel_ms;                /* total CPU time of the panel */
    double events_ms;               /* total CPU time of event handling */
    size_t drawn, panels;           /* counts of pictures and panels */
} PlayMeter;

/* Returns the wall time since the process began, ms, including program start. 0 if /proc cannot be read. */
double meter_process_age_ms(void);

/* Reports that an event at `when_ms` became a command. */
void meter_event(PlayMeter *meter, double when_ms, uint64_t command);

/* Reports a picture on the screen, of a state after `obeyed` commands. */
void meter_picture(PlayMeter *meter, double now_ms, uint64_t obeyed);

/* Reports if time is paused: pictures then follow user actions, and do not count as a rate. */
void meter_rest(PlayMeter *meter, bool rests);

/* Reports the first picture of a state, the start of the session. Returns false if there was an earlier
   one. */
bool meter_begin(PlayMeter *meter, double now_ms);

/* CPU time of the process; of the calling thread; ms. */
double meter_cpu_ms(void);
double meter_thread_cpu_ms(void);

/* Report the time of a picture, and the panel's CPU time; the means are over all pictures. */
void meter_drawn(PlayMeter *meter, double ms);
void meter_panel(PlayMeter *meter, double cpu_ms);
double meter_drawn_mean(const PlayMeter *meter);
double meter_panel_mean(const PlayMeter *meter);

/* Reports CPU time of event handling, between and during pictures; the mean is per picture. */
void meter_events(PlayMeter *meter, double cpu_ms);
double meter_events_mean(const PlayMeter *meter);

/* Fills in the times between pictures, oldest first; returns their count. */
int meter_history(const PlayMeter *meter, float out[METER_HISTORY]);

/* Returns the quantile `fraction` of the latencies, ms; 0 without any. */
double meter_latency(const PlayMeter *meter, double fraction);

/* Forgets waiting events: another scene restarts the command numbers. */
void meter_forget(PlayMeter *meter);

#endif
