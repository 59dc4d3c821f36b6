/* Measurements of the live window: pictures per second, time from start to the first picture, and delay
   from an event to the first picture showing its effect. Pure, except for the clocks of the process. */
#ifndef APP_WINDOW_FRAME_TIMES_H
#define APP_WINDOW_FRAME_TIMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FRAME_TIMES_HISTORY = 120, FRAME_TIMES_WAITING_MAX = 256, FRAME_TIMES_SAMPLES_MAX = 1 << 14 };

/* An event turned into a command: time of the event, number of the command. */
typedef struct FrameEvent {
    double when_ms;
    uint64_t command;
} FrameEvent;

/* Zero-initialise before use. Times are wall_ms(). */
typedef struct FrameTimes {
    double first_ms;                    /* from process start to the first picture; 0: none yet */
    double last_ms;                     /* wall time of the last picture */
    size_t pictures;                    /* total */
    double second_began_ms;             /* of the present count */
    int in_second;                      /* pictures in that second */
    double pictures_per_second;         /* of the last second */
    float history[FRAME_TIMES_HISTORY]; /* times between pictures, ms, without pauses; ring buffer */
    bool rests;                         /* set by frame_times_pause */
    int history_next, history_count;
    int waiting_count;
    FrameEvent waiting[FRAME_TIMES_WAITING_MAX]; /* not shown yet, ordered by command */
    size_t latencies;                            /* count of shown events */
    float latency_ms[FRAME_TIMES_SAMPLES_MAX];   /* latencies of the last events; ring buffer */
    double began_ms, began_cpu_ms;  /* wall and CPU time of the first picture of a state; 0: none yet */
    double drawn_ms, last_drawn_ms; /* wall time of drawing: total; last picture */
    double panel_ms;                /* total CPU time of the panel */
    double events_ms;               /* total CPU time of event handling */
    size_t drawn, panels;           /* counts of pictures and panels */
} FrameTimes;

/* Returns the wall time since the process began, ms, including program start. 0 if /proc cannot be read. */
double process_age_ms(void);

/* Reports that an event at `when_ms` became a command. */
void frame_times_event(FrameTimes *frame_times, double when_ms, uint64_t command);

/* Reports a picture on the screen, of a state after `obeyed` commands. */
void frame_times_picture(FrameTimes *frame_times, double now_ms, uint64_t obeyed);

/* Reports if time is paused: pictures then follow user actions, and do not count as a rate. */
void frame_times_pause(FrameTimes *frame_times, bool rests);

/* Reports the first picture of a state, the start of the session. Returns false if there was an earlier
   one. */
bool frame_times_begin(FrameTimes *frame_times, double now_ms);

/* CPU time of the process; of the calling thread; ms. */
double process_cpu_ms(void);
double thread_cpu_ms(void);

/* Report the time of a picture, and the panel's CPU time; the means are over all pictures. */
void frame_times_drawn(FrameTimes *frame_times, double ms);
void frame_times_panel(FrameTimes *frame_times, double cpu_ms);
double frame_times_drawn_mean(const FrameTimes *frame_times);
double frame_times_panel_mean(const FrameTimes *frame_times);

/* Reports CPU time of event handling, between and during pictures; the mean is per picture. */
void frame_times_events(FrameTimes *frame_times, double cpu_ms);
double frame_times_events_mean(const FrameTimes *frame_times);

/* Fills in the times between pictures, oldest first; returns their count. */
int frame_times_history(const FrameTimes *frame_times, float out[FRAME_TIMES_HISTORY]);

/* Returns the quantile `fraction` of the latencies, ms; 0 without any. */
double frame_times_latency(const FrameTimes *frame_times, double fraction);

/* Forgets waiting events: another scene restarts the command numbers. */
void frame_times_forget_events(FrameTimes *frame_times);

#endif
