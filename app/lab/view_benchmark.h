/* Distance between a picture and a reference picture: pure functions of linear light. */
#ifndef APP_LAB_VIEW_BENCHMARK_H
#define APP_LAB_VIEW_BENCHMARK_H

#include "app/lab/experiment.h"
#include "app/run/offscreen.h"
#include "app/scene/scene.h"
#include "render/frame/view.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct LinearPicture {
    int width, height;
    float *rgb; /* 3 * width * height, linear light, 1 is white; owned */
} LinearPicture;

/* Averages blocks of `factor` x `factor` sRGB pixels in linear light. `srgb` has 3 * factor * width *
   factor * height bytes. Returns false if memory is short. */
bool linear_picture_make(LinearPicture *picture, const uint8_t *srgb, int width, int height, int factor);
void linear_picture_free(LinearPicture *picture);

/* Root mean square of the difference, over all pixels and three colours; a fraction of white. Here and
   below both pictures have the same size. */
double picture_rms(const LinearPicture *a, const LinearPicture *b);

/* 1 - SSIM, mean over blocks of 8 x 8 pixels of luma: 0 for equal structures, 1 for entirely different
   structures. After: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment", 2004, with its K1 =
   0.01, K2 = 0.03, but blocks in place of its sliding window. */
double picture_structure(const LinearPicture *a, const LinearPicture *b);

/* A picture of a state with a view, and its drawing time. */

enum { VIEW_PICTURE_FACTOR = 8 };

/* Returns the supersampling factor for a picture of the given size: VIEW_PICTURE_FACTOR, or less if limited
   by the driver or by 16 million pixels. Needs a current context. */
int view_picture_factor(int width, int height);

typedef struct ViewPicture {
    LinearPicture picture; /* of the requested size; owned */
    double ms;             /* drawing time: the least of several pictures */
    char clock[NAME_SIZE]; /* "gl" or "finish" */
} ViewPicture;

/* Draws the world's state with the scene's view, `factor` times as large, several times if `timed`. Call
   linear_picture_free(&shot->picture) in either case. */
bool view_picture_draw(const Scene *scene, World *world, int width, int height, int factor, bool timed,
                       ViewPicture *out, Error *error);

/* One picture of `slosh chart --views`: its view, settings, drawing time and error. */

enum { VIEW_ROWS_MAX = 192, VIEW_SETTINGS = 160 };

typedef struct ViewRow {
    uint64_t key; /* hash of all inputs of the picture; of the machine only the renderer */
    char view[NAME_SIZE];
    char settings[VIEW_SETTINGS]; /* "as it is", "cells=48" */
    char clock[NAME_SIZE];        /* "gl" or "finish" */
    double ms;                    /* per picture; NaN: not drawn */
    double error, structure;      /* picture_rms and picture_structure from the view's reference; or NaN */
} ViewRow;

extern const TrialTable view_table;

static inline ViewRow *view_row(const Trials *rows, int i)
{
    return trials_row(rows, i);
}

/* view_on_front: true if no other picture of the view is both cheaper and more accurate; errors within the
   factor VIEW_EQUAL count as equal. */
#define VIEW_EQUAL 1.01
bool view_on_front(const Trials *rows, int row);

typedef struct ViewWords {
    const char *title, *note, *renderer;
} ViewWords;

/* Draws the chart as FILE.svg or FILE.png: error over time, one colour per view. */
bool view_rows_draw(const Trials *rows, const ViewWords *words, const char *path, Error *error);

/* Prints one line per row. */
void view_rows_print(const Trials *rows, const ViewWords *words, FILE *file);

/* A row for --json. */
json_t *view_row_json(const Trials *rows, int i);

/* Plan of `slosh chart --views`. Each view has a picture with the scene's own settings, and
   one with each grade of each of its keys (ViewKind.grades). Two more have all keys at the coarsest, and all
   at the finest; they are skipped if equal to a single grade. The reference has all keys at the finest, and
   is supersampled. */

enum { VIEW_SETS = 12, VIEW_SET_NAME = 80, VIEW_JOBS_MAX = VIEW_ROWS_MAX, VIEW_REFERENCES = 16 };

typedef struct ViewJob {
    const ViewKind *kind;
    int reference; /* place in `references` */
    int set_count;
    char set[VIEW_SETS][VIEW_SET_NAME]; /* "--set key=value" */
    char name[VIEW_SETTINGS];           /* ViewRow.settings */
} ViewJob;

typedef struct ViewPlan {
    const char *scene;             /* name for scene_load */
    const SceneSettings *settings; /* of the command line */
    int count, reference_count;
    ViewJob jobs[VIEW_JOBS_MAX], references[VIEW_REFERENCES];
} ViewPlan;

/* Plans the view named on the command line (--set view.kind=...), or all views. */
bool view_plan_make(const Args *args, ViewPlan *plan, Error *error);

/* Loads the scene of a job, without legend and box edges: their width is in pixels, whatever the size. */
bool view_job_scene(const ViewPlan *plan, const ViewJob *job, Scene *scene, Error *error);

#endif
