/* The commands of the window, one function each where it takes more than a line. */
#include "app/play/play_state.h"
#include "render/frame/colormap.h"
#include "sim/base/scalar.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void set_speed(Play *play, double factor)
{
    static const double slowest = 1.0 / 64, fastest = 64;
    play->speed = fmin(fmax(play->speed * factor, slowest), fastest);
    simulator_set_speed(play->open.simulator, play->speed);
    play_tell(play, "speed %g", play->speed);
}

static void set_paused(Play *play, bool paused)
{
    play->paused = paused;
    simulator_pause(play->open.simulator, paused);
}

static void step_once(Play *play)
{
    play->paused = true;
    simulator_single_step(play->open.simulator);
}

/* One that is broken is left out. */
static void open_neighbour(Play *play, int by)
{
    char path[1024], present[1024];
    bool opened = false;
    snprintf(present, sizeof present, "%s", play->open.scene.path);
    for (int way = by; !opened && play_scene_neighbour(present, way, path) && strcmp(path, present) != 0;
         way += by) {
        Error error = {{0}};
        opened = play_open(play, path, NULL, &error);
        if (!opened)
            play_error(play, error.message);
    }
    if (!opened)
        play_tell(play, "there is no other scene to open beside %s", present);
}

/* A range that the file gives belongs to the file's scalar. */
static void next_scalar(Play *play)
{
    ViewDef *view = &play->open.scene.view;
    view->color_by = (Scalar)((view->color_by + 1) % SCALAR_COUNT);
    const bool files = view->color_by == play->file_scene.view.color_by;
    view->range_auto = files ? play->file_scene.view.range_auto : true;
    memcpy(view->range, play->file_scene.view.range, sizeof view->range);
    play_view_changed(play);
    play_tell(play, "coloured by %s", scalar_name(view->color_by));
}

static void next_colormap(Play *play)
{
    ViewDef *view = &play->open.scene.view;
    int i = 0;
    while (colormap_list[i] && strcmp(colormap_list[i], view->colormap) != 0)
        i++;
    const char *next = colormap_list[i] && colormap_list[i + 1] ? colormap_list[i + 1] : colormap_list[0];
    snprintf(view->colormap, sizeof view->colormap, "%s", next);
    play_view_changed(play);
    play_tell(play, "colours %s", next);
}

static void camera_home(Play *play)
{
    ViewDef *view = &play->open.scene.view;
    play->orbiting = false;
    view->camera_auto = play->file_scene.view.camera_auto;
    view->camera = play->file_scene.view.camera;
    play_view_changed(play);
}

static void quit_or_close(Play *play)
{
    if (play->help)
        play->help = false;
    else
        play->quit = true;
}

void play_do(Play *play, PlayCommand command)
{
    play->dirty = true;
    switch (command) {
    case PLAY_PAUSE:
        set_paused(play, !play->paused);
        break;
    case PLAY_STEP:
        step_once(play);
        break;
    case PLAY_RESET:
        play_reset(play);
        break;
    case PLAY_SLOWER:
        set_speed(play, 0.5);
        break;
    case PLAY_FASTER:
        set_speed(play, 2);
        break;
    case PLAY_NEXT_SCENE:
        open_neighbour(play, 1);
        break;
    case PLAY_PREVIOUS_SCENE:
        open_neighbour(play, -1);
        break;
    case PLAY_NEXT_SCALAR:
        next_scalar(play);
        break;
    case PLAY_NEXT_COLORMAP:
        next_colormap(play);
        break;
    case PLAY_SCREENSHOT:
        play->shoot = true;
        break;
    case PLAY_VIDEO:
        play_movie_toggle(play);
        break;
    case PLAY_SAVE_RECORDING:
        play_save(play);
        break;
    case PLAY_FULLSCREEN:
        window_fullscreen(play->window, !window_is_fullscreen(play->window));
        break;
    case PLAY_PANEL:
        play->panel = !play->panel;
        break;
    case PLAY_HELP:
        play->help = !play->help;
        break;
    case PLAY_CAMERA_HOME:
        camera_home(play);
        break;
    case PLAY_BOX_HOME:
        hand_post_home(play->post);
        break;
    case PLAY_NEUTRAL:
        hand_post_neutral(play->post);
        break;
    case PLAY_QUIT:
        quit_or_close(play);
        break;
    default: /* what is done by drags, wheels and sticks: play_input.c */
        break;
    }
}
