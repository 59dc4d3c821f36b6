/* What a session in the window was: as JSON, and for people. */
#ifndef SLOSH_PLAY_REPORT_H
#define SLOSH_PLAY_REPORT_H

#include "render/panels.h"
#include "sim/base/error.h"
#include "sim/matter/world_def.h"
#include "sim/world/reading.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* What a session was, in the end. */
typedef struct PlayFigures {
    char scene[1024], renderer[256];
    int views, chosen_view;   /* how many are shown; the panel of the one that the rest is of */
    char script[16];          /* script_name, of a recorded session that was played */
    bool recorded;            /* nothing was simulated: there are no figures of a solver */
    double times[PANELS_MAX]; /* of the state that each shows, s */
    char view[NAME_SIZE], color_by[NAME_SIZE], colormap[NAME_SIZE], backend[NAME_SIZE], method[NAME_SIZE];
    char view_settings[4096]; /* JSON: the view's own keys as they are now, as of scene_json */
    char readout[4096];       /* JSON: what the last picture said under the mouse and at pins */
    int width, height, threads, substeps;
    double dt;                          /* of a frame, s; of mode cfl, where each has its own, their mean */
    SolveFigures solved;                /* of the last scene, since its start */
    uint64_t limited[STEP_LIMIT_COUNT]; /* its steps, by what bounded them */
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
    size_t video_pictures; /* of the last video */
    uint64_t device_reports;
    double report_median_ms, report_p99_ms; /* from the report of a motion device to its command */
    double panel_ms;                        /* CPU time of the panel in a picture, mean; 0 when never shown */
    double events_ms;                       /* CPU time of events for a picture, mean */
    double cpus_busy;                       /* CPU time over wall time */
    double speed, display_scale;
    bool at_rest; /* all that was asked for is done and shown; nothing more comes until somebody acts, */
    bool finer_to_come; /* but the same picture in more detail */
    bool paused, fullscreen, camera_auto, panel, help, scenes;
    double box_size[3];                         /* of the last picture, m */
    double box_position[3], box_orientation[4]; /* the hand's part of the pose */
    double camera_from[3], camera_to[3];
    int gl_errors;
    Error failure; /* why it ended early, if it did; without a renderer, before there was a window */
} PlayFigures;

/* An object, with "error" of a session that failed. False with the reason when the file can't be written. */
bool play_write_json(const PlayFigures *figures, const char *path, Error *error);

/* An array, as every `bench --json`. */
bool play_write_json_array(const PlayFigures *figures, size_t count, const char *path, Error *error);

/* The figures of `bench --play`, and what limits them. */
void play_print(const PlayFigures *figures, FILE *file);

#endif
