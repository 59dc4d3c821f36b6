/* The live window: a scene simulated on a thread of its own, drawn, and moved by hand. */
#ifndef SLOSH_PLAY_H
#define SLOSH_PLAY_H

#include "app/device/mapping.h"
#include "app/session/args.h"
#include "sim/base/error.h"

#include <stdint.h>

typedef struct PlaySetup {
    const char *scene;
    const SceneSettings *settings; /* of that scene; others open as their files have them */
    int width, height;             /* of the window, in screen coordinates */
    const char *record;            /* the session is written there at the end; or NULL */
    const Mapping *mapping;        /* of motion devices; NULL: they are left alone */
    const char *device;            /* --device, or NULL: what is plugged in */
    double shake_seconds;          /* more than 0: the box is shaken by a script for so long, then all ends */
    bool quiet;
} PlaySetup;

/* What a session was, in the end. */
typedef struct PlayFigures {
    char scene[1024], renderer[256];
    char view[NAME_SIZE], color_by[NAME_SIZE], colormap[NAME_SIZE], backend[NAME_SIZE], method[NAME_SIZE];
    int width, height, threads, substeps;
    double dt; /* s */
    size_t particles, pictures, scenes_opened;
    uint64_t step;              /* of the last state */
    double time;                /* of the last state, s */
    double simulated_s, wall_s; /* since the first picture, all scenes and resets together */
    double real_time_factor, pictures_per_second;
    double first_picture_ms;  /* since the start of the process */
    double frame_ms;          /* mean from picture to picture */
    double sim_ms, render_ms; /* a frame of the solver, a picture: means */
    double latency_median_ms, latency_p95_ms;
    size_t latency_events;
    uint64_t device_reports;
    double report_median_ms, report_p99_ms; /* from the report of a motion device to its command */
    double panel_ms;                        /* CPU time of the panel in a picture, mean; 0 when never shown */
    double cpus_busy;                       /* CPU time over wall time */
    double speed, display_scale;
    bool paused, fullscreen, camera_auto, panel, help;
    double box_position[3], box_orientation[4]; /* the hand's part of the pose */
    double camera_from[3], camera_to[3];
    int gl_errors;
} PlayFigures;

/* Runs until the user, a signal or the script ends it. Returns the exit code; on failure the message has been
   printed. */
int play(const PlaySetup *setup, PlayFigures *figures);

#endif
